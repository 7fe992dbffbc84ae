#include "gi/gather.h"

#include "gi/hessian.h"
#include "gi/layers.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// At `maxerror` 1, in squared pixels: about as many records as the paper's function (docs/gi.md).
constexpr float kHessianTolerance = 4;

/// Where in each cell its ray goes: correlated multi-jitter (Kensler 2013). The columns of a ring take
/// different heights in their cells and the rings of a sector different angles, so both projections are
/// stratified as finely as there are rays; plain jitter in the cells costs a third more rays for the same
/// error (docs/performance.md).
class CellJitter {
 public:
  CellJitter(const HemisphereCells& cells, uint32_t key)
      : key_(key),
        height_(permutation(cells.sectors, key ^ 0x51633e2dU)),
        angle_(permutation(cells.rings, key ^ 0x68bc21ebU)) {}

  vec2 operator()(int ring, int sector, uint32_t ray) const {
    const uint32_t name = hashCombine(key_, ray);
    return {within(height_, sector, name ^ 0x3c6ef372U), within(angle_, ring, name ^ 0xa54ff53aU)};
  }

 private:
  static float within(const std::vector<int>& strata, int i, uint32_t name) {
    return (static_cast<float>(strata[static_cast<size_t>(i)]) + unitFloat(hash32(name))) /
           static_cast<float>(strata.size());
  }
  uint32_t key_;
  std::vector<int> height_, angle_;
};

/// When each ray is shot: equal strata of the shutter in an order that has nothing to do with the cells.
class RayTimes {
 public:
  RayTimes(const RayScene& scene, const GatherPoint& point, size_t count, uint32_t key) : fixed_(std::max(point.time, 0.0f)), key_(key) {
    if (point.time < 0 && scene.samplesTime(point.group)) strata_ = permutation(static_cast<int>(count), key ^ 0x74696d65U);
  }
  float operator()(size_t ray) const {
    if (strata_.empty()) return fixed_;
    const float inside = unitFloat(hashCombine(key_, static_cast<uint32_t>(ray), 0x74696d65U));
    return std::min((static_cast<float>(strata_[ray]) + inside) / static_cast<float>(strata_.size()), 0x1.fffffep-1f);
  }

 private:
  float fixed_;
  uint32_t key_;
  std::vector<int> strata_;
};

/// Kept by each thread from one record to the next. Gather rays shade without indirect light, so gathering
/// never nests.
struct Scratch {
  RayLayers layers;
  std::vector<Hit> hits;
  HitAnswers answers;
  std::vector<vec3> directions, radiance;
  std::vector<float> distances;
};

}  // namespace

IrradianceRecord gather(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
                        const GatherSettings& settings, Stats& stats) {
  const HemisphereCells cells = hemisphereCells(settings.samples);
  const size_t count = static_cast<size_t>(cells.rings) * static_cast<size_t>(cells.sectors);
  HemisphereSamples samples{cells, {}, {}, point.normal, {}, {}, {}};
  orthonormalBasis(point.normal, samples.tangent, samples.bitangent);

  thread_local Scratch scratch;
  Ray ray{point.position, point.normal, settings.maxDistance};
  scene.prepareOrigin(point.group, point.position, point.edgeLength, ray);
  scratch.layers = {};
  scratch.directions.resize(count), scratch.distances.resize(count), scratch.radiance.assign(count, vec3(0));
  const uint32_t key = hashCombine(point.key, settings.seed);
  const CellJitter jitter(cells, key);
  const RayTimes times(scene, point, count, key);
  for (size_t i = 0; i < count; ++i) {
    const int ring = static_cast<int>(i) / cells.sectors, sector = static_cast<int>(i) % cells.sectors;
    const auto number = static_cast<uint32_t>(i);
    const vec3 local = hemisphereDirection(cells, ring, sector, jitter(ring, sector, number));
    Ray r = ray;
    r.direction = scratch.directions[i] =
        local.x * samples.tangent + local.y * samples.bitangent + local.z * point.normal;
    r.offset = slantedOffset(ray.offset, local.z);
    r.time = times(i);
    if (r.time > 0) r.origin = scene.placeAt(point.group, point.position, point.drift, r.time);
    // A cell of a cosine-weighted hemisphere has the solid angle pi / (n cos).
    r.spread = 1 / std::sqrt(static_cast<float>(count) * std::max(local.z, 0.05f));
    scratch.layers.add(static_cast<int>(i), r, {key, number});
  }
  ShadeContext context{RayKind::Diffuse, 1, settings.seed, 1, false};
  context.light = settings.light;
  context.diffuseLimit = 0;  // of direct light the diffuse component alone; mirrors and glass show what they show
  scratch.answers.mode = HitMode::Shader;
  for (int layer = 0; layer < kMostLayers && !scratch.layers.rays.empty(); ++layer) {
    stats.rays.hitlistAdjusted += scratch.layers.meet(scene, kMaskDiffuse, scratch.hits);
    stats.rays.gather += static_cast<int64_t>(scratch.hits.size());
    for (size_t i = 0; layer == 0 && i < count; ++i)
      scratch.distances[i] = scratch.hits[i].object < 0 ? kInfinity : std::max(0.0f, scratch.hits[i].t);
    scene.shadeHits(scratch.layers.rays, scratch.hits, scratch.layers.names, shading, context, scratch.answers);
    scratch.layers.goOn(scene, scratch.hits, scratch.answers, 1, [&](int cell, const vec3& radiance, const vec3&) {
      scratch.radiance[static_cast<size_t>(cell)] += radiance;
    });
  }

  samples.directions = scratch.directions, samples.radiance = scratch.radiance,
  samples.distances = scratch.distances;
  IrradianceRecord record = summarize(samples);
  record.position = point.position;
  record.pixelSize = point.pixelSize;
  if (settings.curvature) {
    const IrradianceCurvature curvature = curvatureOf(samples);
    std::copy_n(curvature.gradient, 3, record.translationGradient);
    record.smoothRadius = hessianRadius(curvature, luminance(record.E), point.pixelSize, kHessianTolerance);
  }
  return record;
}

}  // namespace tomales
