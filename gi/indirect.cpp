// The two answers to indirectDiffuse(): interpolated from the irradiance cache, and path traced.
#include "gi/state.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr size_t kRaysPerBatch = 4096;  // shaded together
constexpr uint32_t kPathStream =
    0x70617468U;  // keeps directions independent of the light samples at the same point

// Ward's split sphere needs a = 1/4 for the error that the paper's function has at kappa = 1 (docs/gi.md), so that `maxerror`
// means the same for both.
constexpr float kWardKappa = 4;

vec3 unitNormal(const ShadePoints& points, TmConstVec3 N, int i) {
  return normalizeOr({N.x[i], N.y[i], N.z[i]}, points.facingNormal(i));
}

// Sums of one point over its paths.
struct PathSum {
  int point;
  vec3 radiance{0.0f};
  vec3 directions[3] = {vec3(0.0f), vec3(0.0f), vec3(0.0f)};
};

// The hemisphere of each active point, one cosine-weighted ray a path, in batches large enough to shade well.
class PathBatches {
 public:
  PathBatches(const GiState& state, const ShadePoints& points, TmConstVec3 N, float maxDistance,
              const ShadeContext& hitContext)
      : state_(state), points_(points), N_(N), maxDistance_(maxDistance), context_(hitContext) {}

  void add(PathSum& sum, int paths) {
    const int i = sum.point;
    const vec3 normal = unitNormal(points_, N_, i);
    vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    const uint32_t pointKey =
        hashCombine(points_.key(i), state_.settings.seed, static_cast<uint32_t>(context_.depth));
    for (int path = 0; path < paths; ++path) {
      Ray ray{points_.position(i), normal};
      aim(state_.rays, points_, i, rayTime(state_.rays, points_, i, path, paths, state_.settings.seed), ray);
      ray.tMax = maxDistance_;
      const vec3 local = cosineHemisphere(sobol2(static_cast<uint32_t>(path), pointKey));
      ray.direction = local.x * tangent + local.y * bitangent + local.z * normal;
      ray.offset = slantedOffset(ray.offset, local.z);
      rays_.push_back(ray);
      names_.push_back({hashCombine(pointKey, static_cast<uint32_t>(path)), 0});
      sums_.push_back(&sum);
      if (rays_.size() == kRaysPerBatch) flush();
    }
  }

  void flush() {
    if (rays_.empty()) return;
    hits_.clear();
    int64_t adjusted = 0;
    for (const Ray& ray : rays_) {
      hits_.push_back(state_.rays.closest(ray, kMaskDiffuse));
      adjusted += hits_.back().adjusted;
    }
    state_.rays.shadeHits(rays_, hits_, names_, state_.shading, context_, radiance_);
    for (size_t r = 0; r < rays_.size(); ++r) {
      if (!isFinite(radiance_[r])) continue;  // one bad shader result would cost the whole point
      sums_[r]->radiance += radiance_[r];
      for (int c = 0; c < 3; ++c) sums_[r]->directions[c] += radiance_[r][c] * rays_[r].direction;
    }
    state_.stats.rays.reference += static_cast<int64_t>(rays_.size());
    state_.stats.rays.hitlistAdjusted += adjusted;
    rays_.clear(), names_.clear(), sums_.clear();
  }

 private:
  const GiState& state_;
  const ShadePoints& points_;
  const TmConstVec3 N_;
  const float maxDistance_;
  const ShadeContext context_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<SampleName> names_;
  std::vector<PathSum*> sums_;
  std::vector<vec3> radiance_;
};

}  // namespace

GatherPlan planFor(const GiState& state, int group, const IndirectQuery& query) {
  const Attributes& attributes = *state.scene.groups[static_cast<size_t>(group)].attributes;
  const GiSettings& settings = state.settings;
  GatherPlan plan;
  plan.cache.errorFunction = query.errorFunction == "ward" ? ErrorFunction::Ward : ErrorFunction::Screen;
  const float maxError =
      settings.maxError >= 0 ? settings.maxError : attributes.irradianceMaxError.value_or(query.maxError);
  const float kappaAtOne = plan.cache.errorFunction == ErrorFunction::Ward ? kWardKappa : 1.0f;
  plan.cache.kappa = maxError > 0 ? kappaAtOne / maxError : kInfinity;
  plan.cache.maxPixels = attributes.irradianceMaxPixelDist.value_or(plan.cache.maxPixels);
  plan.gather.samples = std::max(1, settings.samples > 0 ? settings.samples : query.samples);
  plan.gather.maxDistance = query.maxDistance;
  plan.gather.seed = settings.seed;
  return plan;
}

float projectedPixelSize(const Camera& camera, const vec3& P, const vec3& n) {
  constexpr float kLeastCosine = 0.05f;  // grazing views would let one record reach over whole objects
  const float cosine = std::abs(dot(normalizeOr(camera.incident(P), n), n));
  return camera.pixelSize(P) / std::sqrt(std::max(cosine, kLeastCosine));
}

void store(const IndirectResult& out, int i, const vec3& E, const vec3 dominant[3]) {
  const auto put = [i](TmVec3 to, const vec3& v) { to.x[i] = v.x, to.y[i] = v.y, to.z[i] = v.z; };
  put(out.E, E);
  for (int c = 0; c < 3; ++c)
    if (out.dominant[c].x) put(out.dominant[c], dominant[c]);
}

void interpolateIndirect(const GiState& state, const ShadePoints& points, const uint8_t* active,
                         TmConstVec3 N, const IndirectQuery& query, const IndirectResult& out) {
  const GatherPlan plan = planFor(state, points.group(), query);
  const auto prepared = std::find_if(state.caches.begin(), state.caches.end(),
                                     [&](const PreparedCache& c) { return c.plan == plan; });
  int64_t lookups = 0, interpolated = 0;
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i]) continue;
    const vec3 P = points.position(i), n = unitNormal(points, N, i);
    const float pixelSize = projectedPixelSize(state.camera, P, n);
    if (prepared != state.caches.end()) {
      ++lookups;
      const IrradianceEstimate estimate = prepared->cache.lookup(P, n, pixelSize);
      if (estimate.weight > 0) {
        ++interpolated;
        store(out, i, estimate.E, estimate.dominant);
        continue;
      }
    }
    // Kept out of the cache: what other points find there must not depend on the order of shading.
    const GatherPoint point{points.group(), P, n, points.key(i), pixelSize, points.edgeLength(i), points.get3(kDriftX, i), points.channel(kTime)[i]};
    const IrradianceRecord record = gather(state.rays, state.shading, point, plan.gather, state.stats);
    store(out, i, record.E, record.dominant);
  }
  state.stats.irradianceCache.lookups += lookups;
  state.stats.irradianceCache.interpolated += interpolated;
}

void traceIndirect(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                   const IndirectQuery& query, const ShadeContext& context, int bounces,
                   const IndirectResult& out) {
  // Paths branch at the eye's points alone; a hit continues because its own shader asks for indirect light
  // again.
  const int paths = context.depth > 0 ? 1 : planFor(state, points.group(), query).gather.samples;
  const int depth = context.depth + 1;
  const ShadeContext hitContext{RayKind::Diffuse, depth, context.seed, 1, depth < bounces};
  PathBatches batches(state, points, N, query.maxDistance, hitContext);
  std::vector<PathSum> sums;
  for (int i = 0; i < points.count(); ++i)
    if (active[i]) sums.push_back({i});
  for (PathSum& sum : sums) batches.add(sum, paths);
  batches.flush();
  for (PathSum& sum : sums) {
    for (vec3& d : sum.directions) d = normalizeOr(d, unitNormal(points, N, sum.point));
    store(out, sum.point, sum.radiance / static_cast<float>(paths), sum.directions);
  }
}

}  // namespace tomales
