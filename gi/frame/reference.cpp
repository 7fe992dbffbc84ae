// Indirect light by path tracing, for the reference, for hits that no cache of their bounce serves, and for hits where
// the atlas does not tell two sides of a wall apart.
#include "gi/frame/reference.h"
#include "gi/frame/cache_keys.h"
#include "gi/frame/gather_places.h"
#include "gi/frame/indirect.h"
#include "gi/frame/ray_start.h"
#include "gi/gather/layers.h"
#include "gi/gather/polygon_start.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr size_t kRaysPerBatch = 4096;  // Paths that are shaded together.
// The share of paths that go on from a place where no map tells the light. It ends paths that never come to a place
// where one does.
constexpr float kGoesOn = 2.0f / 3;

// Sums of one point over its paths.
struct PathSum {
  int point;
  vec3 radiance{0.0f};
  vec3 directions[3] = {vec3(0.0f), vec3(0.0f), vec3(0.0f)};
};

// Traces the hemisphere of each active point, one cosine-weighted ray for each path, in batches large enough to shade
// well.
class PathBatches {
 public:
  PathBatches(const GiState& state, const RayTools& tools, const AskedPoints& asked, const IndirectQuery& query,
              const ShadeContext& hitContext)
      : state_(state),
        tools_(tools),
        asked_(asked),
        points_(asked.points),
        places_(state, asked.points),
        maxDistance_(query.maxDistance),
        context_(hitContext) {
    const Attributes& own = *state.scene.groups[static_cast<size_t>(asked.group())].attributes;
    filter_.groups = tools.rays->groupsIn(own.trace.subsetFor(query.subset), "");
  }

  void add(PathSum& sum, int paths) {
    if (stopRequested()) return;  // a bucket of many paths takes long, and a stopped one is dropped (reyes/frame.h)
    const int i = sum.point;
    const vec3 normal = places_.shading(i, asked_.normal(i));
    vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    // The hits of one record share a key and continue each other's sequence.
    const SampleName name = points_.name(i);
    const uint32_t pointKey = hashCombine(name.key, context_.seed, static_cast<uint32_t>(context_.diffuseDepth));
    const PolygonStart start = startOn(i, normal);
    for (int path = 0; path < paths; ++path) {
      const uint32_t number = name.sequence * static_cast<uint32_t>(paths) + static_cast<uint32_t>(path);
      const vec3 local = cosineHemisphere(sobol2(number, pointKey));
      const float time = rayTime(*tools_.rays, points_, i, path, paths, context_.seed);
      send(sum, start, {local.x * tangent + local.y * bitangent + local.z * normal, local.z, time},
           hashCombine(pointKey, number));
    }
  }

  /// Adds one path that begins along a direction of the point's lobe.
  void addAlong(PathSum& sum, const LobeDirection& way) {
    const int i = sum.point;
    const vec3 normal = points_.facingNormal(i), direction{way.L.x[i], way.L.y[i], way.L.z[i]};
    const SampleName name = points_.name(i);
    const uint32_t number = name.sequence * static_cast<uint32_t>(way.count) + static_cast<uint32_t>(way.number);
    send(sum, startOn(i, normal),
         {direction, std::abs(dot(direction, normal)),
          rayTime(*tools_.rays, points_, i, way.number, way.count, context_.seed)},
         hashCombine(name.key ^ randomStream("refl"), context_.seed, static_cast<uint32_t>(context_.diffuseDepth),
                     number));
  }

  void flush() {
    HitQuestion question;
    question.mode = HitMode::Shader;
    HitAnswers answers;
    for (int layer = 0; layer < kMostLayers && !layers_.rays.empty() && !stopRequested(); ++layer) {
      state_.stats.rays.hitlistAdjusted += layers_.meet(*tools_.rays, kMaskDiffuse, hits_);
      state_.stats.rays.reference += static_cast<int64_t>(layers_.rays.size());
      tools_.rays->shadeHits(layers_.rays, hits_, layers_.names, *tools_.shading, context_, question, answers);
      tools_.rays->throughVolumes(layers_.rays, hits_, layers_.names, kMaskDiffuse, *tools_.shading, context_, answers);
      layers_.goOn(*tools_.rays, hits_, answers, 1, [&](int path, const vec3& radiance, const vec3&) {
        const auto p = static_cast<size_t>(path);
        sums_[p]->radiance += radiance;
        for (int c = 0; c < 3; ++c) sums_[p]->directions[c] += radiance[c] * directions_[p];
      });
    }
    layers_ = {};
    sums_.clear();
    directions_.clear();
  }

 private:
  struct Start {
    vec3 direction;
    float cosine, time;
  };
  void send(PathSum& sum, const PolygonStart& polygon, const Start& start, uint32_t name) {
    Ray ray;
    places_.startRay(*tools_.rays, sum.point, start.time, ray);
    ray.tMax = maxDistance_;
    if (!filter_.passesAll()) ray.filter = &filter_;
    ray.origin += polygon.lift;
    ray.direction = polygon.above(start.direction);
    ray.offset = slantedOffset(ray.offset, start.cosine);
    layers_.add(static_cast<int>(sums_.size()), ray, {name, 0});
    sums_.push_back(&sum);
    directions_.push_back(ray.direction);
    if (sums_.size() == kRaysPerBatch) flush();
  }

  PolygonStart startOn(int i, const vec3& normal) const {
    Ray first;
    first.direction = normal;
    places_.startRay(*tools_.rays, i, 0, first);
    return polygonStart(*tools_.rays, first, kMaskDiffuse);
  }

  const GiState& state_;
  const RayTools& tools_;
  const AskedPoints asked_;
  const ShadePoints& points_;
  const GatherPlaces places_;
  const float maxDistance_;
  const ShadeContext context_;
  RayFilter filter_;
  RayLayers layers_;
  std::vector<Hit> hits_;
  std::vector<PathSum*> sums_;    ///< The sum that each path since the last flush adds to.
  std::vector<vec3> directions_;  ///< The direction of each of those paths.
};

ShadeContext contextOfPaths(const GiState& state, const ShadeContext& context, int bounces) {
  const int depth = context.diffuseDepth + 1;
  ShadeContext out{.kind = RayKind::Diffuse,
                   .diffuseDepth = depth,
                   .seed = context.seed,
                   .lightSamples = 1,
                   .indirect = depth < bounces};
  // The depth also limits wide lobes that shaders follow. Mirrors reflect as deep as their objects allow.
  out.diffuseLimit = bounces;
  out.highlights = HitHighlights::All;
  out.onlyLightGroup = context.onlyLightGroup;
  if (!state.groupsWithCaustics.empty()) out.groupsWithCaustics = &state.groupsWithCaustics;
  out.auditPaths = context.auditPaths;
  return out;
}

}  // namespace

void traceIndirect(const GiState& state, const AskedPoints& asked, const IndirectQuery& query,
                   const ShadeContext& context, int bounces, const IndirectResult& out) {
  const RayTools* tools = state.rays();
  if (!tools) return;
  // Paths branch at the eye's points alone; a hit continues because its own shader asks for indirect light
  // again.
  const int paths = context.diffuseDepth > 0 ? 1
                    : context.auditPaths > 0
                        ? context.auditPaths
                        : shareOfBranch(cacheKeyFor(state, asked.group(), query).gather.samples, 1, context);
  PathBatches batches(state, *tools, asked, query, contextOfPaths(state, context, bounces));
  std::vector<PathSum> sums;
  for (int i = 0; i < asked.count(); ++i)
    if (asked.active[i]) sums.push_back({i});
  for (PathSum& sum : sums) batches.add(sum, paths);
  batches.flush();
  for (PathSum& sum : sums) {
    for (vec3& d : sum.directions) d = normalizeOr(d, asked.normal(sum.point));
    setIndirect(out, sum.point, sum.radiance / static_cast<float>(paths), sum.directions);
  }
}

void traceAlong(const GiState& state, const ShadePoints& points, const uint8_t* active, const LobeDirection& way,
                const IndirectQuery& query, const ShadeContext& context, int bounces, TmVec3 out) {
  const RayTools* tools = state.rays();
  if (!tools) return;
  PathBatches batches(state, *tools, {points, active, way.L}, query, contextOfPaths(state, context, bounces));
  std::vector<PathSum> sums;
  for (int i = 0; i < points.count(); ++i)
    if (active[i]) sums.push_back({i});
  for (PathSum& sum : sums) batches.addAlong(sum, way);
  batches.flush();
  for (const PathSum& sum : sums) set(out, sum.point, sum.radiance);
}

void traceToStored(const GiState& state, const ShadePoints& points, const std::vector<int>& which, TmVec3 E) {
  const RayTools* tools = state.rays();
  if (!tools) return;
  std::vector<float> normals(3 * static_cast<size_t>(points.count()));
  float* const n[] = {normals.data(), normals.data() + points.count(), normals.data() + 2 * points.count()};
  std::vector<PathSum> sums;
  for (const int i : which) {
    E.x[i] = E.y[i] = E.z[i] = 0;
    const uint32_t name = hashCombine(points.name(i).key, points.name(i).sequence, state.settings.seed);
    if (unitFloat(hash32(name ^ randomStream("path"))) >= kGoesOn) continue;
    const vec3 facing = points.facingNormal(i);
    for (int k = 0; k < 3; ++k) n[k][i] = facing[k];
    sums.push_back({i});
  }
  ShadeContext context{
      .kind = RayKind::Diffuse, .diffuseDepth = 1, .seed = state.settings.seed, .lightSamples = 1, .indirect = false};
  context.illumination = Illumination::LightsAndStored;
  context.specularRaysSeeLights =
      state.scene.groups[static_cast<size_t>(points.group())].attributes->photon.causticMap.empty();
  context.highlights = highlightsOfHits(context.specularRaysSeeLights);
  context.diffuseLimit = 0;
  PathBatches batches(state, *tools, {points, nullptr, {n[0], n[1], n[2]}}, {}, context);
  for (PathSum& sum : sums) batches.add(sum, 1);
  batches.flush();
  for (const PathSum& sum : sums) {
    const vec3 e = sum.radiance / kGoesOn;
    E.x[sum.point] = e.x;
    E.y[sum.point] = e.y;
    E.z[sum.point] = e.z;
  }
}

}  // namespace tomales
