#include "gi/gather.h"

#include "gi/hessian.h"
#include "gi/layers.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// At `maxerror` 1, in squared pixels: about as many records as the paper's function (docs/gi.md).
constexpr float kHessianTolerance = 4;
constexpr float kContrast = 4;  ///< Between neighbours of a cell, in means of the hemisphere: a small bright source.
constexpr int kMostSplit = 8;

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
  std::vector<vec3> directions, radiance, fine;
  std::vector<float> distances;
};

/// Where light changes fast: cells whose neighbours differ by more than kContrast times the mean. A cell's own ray has no say, so
/// that choosing cells for more rays leaves the estimate unbiased.
std::vector<int> contrastCells(const HemisphereCells& cells, std::span<const vec3> radiance) {
  const int M = cells.rings, N = cells.sectors;
  const auto light = [&](int j, int k) { return luminance(radiance[static_cast<size_t>(j * N + (k + N) % N)]); };
  float mean = 0;
  for (const vec3& L : radiance) mean += luminance(L) / static_cast<float>(radiance.size());
  std::vector<int> out;
  for (int j = 0; j < M; ++j)
    for (int k = 0; k < N; ++k) {
      float least = kInfinity, most = 0;
      for (int ring = std::max(j - 1, 0); ring <= std::min(j + 1, M - 1); ++ring)
        for (int side = -1; side <= 1; ++side) {
          if (ring == j && side == 0) continue;
          least = std::min(least, light(ring, k + side)), most = std::max(most, light(ring, k + side));
        }
      if (most - least > kContrast * mean) out.push_back(j * N + k);
    }
  return out;
}

/// The rays of one record.
class Hemisphere {
 public:
  Hemisphere(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point, const GatherSettings& settings)
      : scene_(scene),
        shading_(shading),
        point_(point),
        settings_(settings),
        cells_(hemisphereCells(settings.samples)),
        count_(static_cast<size_t>(cells_.rings) * static_cast<size_t>(cells_.sectors)),
        key_(hashCombine(point.key, settings.seed)),
        times_(scene, point, count_, key_) {
    orthonormalBasis(point.normal, tangent_, bitangent_);
    first_.spread = 1 / std::sqrt(static_cast<float>(count_));
    scene.prepareOrigin(point.group, point.position, point.edgeLength, first_);
  }

  HemisphereSamples trace(Stats& stats) {
    const CellJitter jitter(cells_, key_);
    scratch_.directions.clear();
    for (size_t i = 0; i < count_; ++i) {
      const int ring = static_cast<int>(i) / cells_.sectors, sector = static_cast<int>(i) % cells_.sectors;
      add(static_cast<int>(i), static_cast<int>(i), jitter(ring, sector, static_cast<uint32_t>(i)), count_);
      scratch_.directions.push_back(scratch_.layers.rays.back().direction);
    }
    scratch_.distances.assign(count_, kInfinity);
    shade(stats, scratch_.radiance);
    refine(stats);
    return {cells_, tangent_, bitangent_, point_.normal, scratch_.directions, scratch_.radiance, scratch_.distances};
  }

 private:
  void add(int element, int cell, const vec2& xi, size_t raysOfHemisphere) {
    const vec3 local = hemisphereDirection(cells_, cell / cells_.sectors, cell % cells_.sectors, xi);
    Ray r = first_;
    r.direction = local.x * tangent_ + local.y * bitangent_ + local.z * point_.normal;
    r.offset = slantedOffset(first_.offset, local.z);
    r.time = times_(static_cast<size_t>(cell));
    if (r.time > 0) r.origin = scene_.placeAt(point_.group, point_.position, point_.drift, r.time);
    // A cell of a cosine-weighted hemisphere has the solid angle pi / (n cos).
    r.spread = 1 / std::sqrt(static_cast<float>(raysOfHemisphere) * std::max(local.z, 0.05f));
    scratch_.layers.add(element, r, {key_, number_++});
  }

  /// What the added rays see, by their elements; of the first rays also how far.
  void shade(Stats& stats, std::vector<vec3>& radiance) {
    const size_t elements = scratch_.layers.rays.size();
    radiance.assign(elements, vec3(0));
    ShadeContext context{RayKind::Diffuse, 1, settings_.seed, 1, false};
    context.light = settings_.light;
    context.diffuseLimit = 0;  // of direct light the diffuse component alone; mirrors and glass show what they show
    scratch_.answers.mode = HitMode::Shader;
    for (int layer = 0; layer < kMostLayers && !scratch_.layers.rays.empty(); ++layer) {
      stats.rays.hitlistAdjusted += scratch_.layers.meet(scene_, kMaskDiffuse, scratch_.hits);
      stats.rays.gather += static_cast<int64_t>(scratch_.hits.size());
      for (size_t i = 0; layer == 0 && &radiance == &scratch_.radiance && i < elements; ++i)
        if (scratch_.hits[i].object >= 0) scratch_.distances[i] = std::max(0.0f, scratch_.hits[i].t);
      scene_.shadeHits(scratch_.layers.rays, scratch_.hits, scratch_.layers.names, shading_, context, scratch_.answers);
      scratch_.layers.goOn(scene_, scratch_.hits, scratch_.answers, 1,
                           [&](int element, const vec3& seen, const vec3&) { radiance[static_cast<size_t>(element)] += seen; });
    }
  }

  /// Up to half as many rays again, in strata of the cells where light changes fast.
  void refine(Stats& stats) {
    const std::vector<int> chosen = contrastCells(cells_, scratch_.radiance);
    if (chosen.empty()) return;
    const int split = std::min(kMostSplit, static_cast<int>(std::sqrt(0.5f * static_cast<float>(count_) / static_cast<float>(chosen.size()))));
    if (split < 2) return;
    scratch_.layers = {};
    const int strata = split * split;
    for (size_t c = 0; c < chosen.size(); ++c)
      for (int s = 0; s < strata; ++s) {
        const uint32_t name = hashCombine(key_, number_, 0x66696e65U);
        const vec2 inside{unitFloat(hash32(name)), unitFloat(hash32(name ^ 0x9e3779b9U))};
        add(static_cast<int>(c) * strata + s, chosen[c], (vec2(s / split, s % split) + inside) / static_cast<float>(split),
            count_ * static_cast<size_t>(strata));
      }
    shade(stats, scratch_.fine);
    for (size_t c = 0; c < chosen.size(); ++c) {
      vec3& L = scratch_.radiance[static_cast<size_t>(chosen[c])];
      for (int s = 0; s < strata; ++s) L += scratch_.fine[c * static_cast<size_t>(strata) + static_cast<size_t>(s)];
      L /= static_cast<float>(strata + 1);
    }
  }

  static Scratch& emptyScratch() {
    thread_local Scratch scratch;
    scratch.layers = {};
    return scratch;
  }

  const RayScene& scene_;
  const ShadingSystem& shading_;
  const GatherPoint& point_;
  const GatherSettings& settings_;
  const HemisphereCells cells_;
  const size_t count_;
  const uint32_t key_;
  const RayTimes times_;
  Ray first_{point_.position, point_.normal, settings_.maxDistance};
  vec3 tangent_, bitangent_;
  uint32_t number_ = 0;
  Scratch& scratch_ = emptyScratch();
};

}  // namespace

IrradianceRecord gather(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
                        const GatherSettings& settings, Stats& stats) {
  Hemisphere hemisphere(scene, shading, point, settings);
  const HemisphereSamples samples = hemisphere.trace(stats);
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
