// Rays that shaders ask for: one from each point of a batch, their hits shaded together.
#include "gi/state.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr int kMostLayers = 64;  ///< Transparent surfaces that one ray goes through.

bool covers(const vec3& clear, const RayQuery& query) { return maxComponent(clear) <= 1 - std::min(query.opacityThreshold, 0.9999f); }

/// Depths and limits of the points that such rays meet: an object's limit counts from its own depth, and never lifts an earlier one.
ShadeContext contextOfHits(const Attributes& own, const RayQuery& query, const ShadeContext& context) {
  ShadeContext hit = context;
  hit.kind = query.kind;
  hit.label = query.label;
  hit.diffuseLimit = std::min(context.diffuseLimit, context.depth + own.trace.maxDiffuseDepth);
  hit.specularLimit = std::min(context.specularLimit, context.specularDepth + own.trace.maxSpecularDepth);
  if (query.kind == RayKind::Diffuse) {
    ++hit.depth, hit.lightSamples = 1, hit.indirect = false;
  } else {
    ++hit.specularDepth;
  }
  return hit;
}

bool isTooDeep(const ShadeContext& hit, const Options& options) {
  return hit.kind == RayKind::Transmission || hit.depth > hit.diffuseLimit || hit.specularDepth > hit.specularLimit ||
         hit.depth + hit.specularDepth > options.maxRayDepth;
}

/// Goes on behind the hit as a ray that leaves it.
Ray behind(const RayScene& scene, const Ray& ray, const Hit& hit) {
  Ray on = ray;
  on.origin = ray.origin + hit.t * ray.direction;
  on.tMax = ray.tMax - hit.t;
  scene.prepareOrigin(scene.groupOf(hit), on.origin, 0, on);
  on.offset = slantedOffset(on.offset, std::abs(dot(ray.direction, hit.geometricNormal)));
  return on;
}

/// The rays of one call, layer by layer.
class ShaderRays {
 public:
  ShaderRays(const GiState& state, const RayTools& tools, const RayQuery& query, const ShadeContext& hitContext, const RayResult& result)
      : state_(state), tools_(tools), query_(query), context_(hitContext), result_(result) {}

  void add(int element, const Ray& ray, SampleName name) {
    rays_.push_back(ray), names_.push_back(name), elements_.push_back(element), clear_.push_back(vec3(1));
  }

  void trace() {
    const bool wantsColor = result_.color.x || result_.opacity.x;
    for (int layer = 0; layer < (wantsColor ? kMostLayers : 1) && !rays_.empty(); ++layer) {
      meet();
      answers_.mode = query_.mode, answers_.wantsColor = wantsColor || asksForSurface(), answers_.elements = elements_;
      answers_.outputs = layer == 0 ? result_.outputs : std::vector<RayOutput>{};
      if (answers_.wantsColor || !answers_.outputs.empty())
        tools_.rays->shadeHits(rays_, hits_, names_, *tools_.shading, context_, answers_);
      if (layer == 0) setDistances();
      if (wantsColor) addLayer();
    }
  }

 private:
  void meet() {
    const RayMask mask = query_.kind == RayKind::Diffuse ? kMaskDiffuse : kMaskSpecular;
    hits_.clear();
    for (const Ray& ray : rays_) {
      hits_.push_back(tools_.rays->closest(ray, mask));
      state_.stats.rays.hitlistAdjusted += hits_.back().adjusted;
    }
    (query_.kind == RayKind::Diffuse ? state_.stats.rays.gather : state_.stats.rays.specular) += static_cast<int64_t>(rays_.size());
  }

  bool asksForSurface() const {
    return std::any_of(result_.outputs.begin(), result_.outputs.end(), [](const RayOutput& o) { return o.name.starts_with("surface:"); });
  }

  void setDistances() {
    if (!result_.distance) return;
    for (size_t r = 0; r < rays_.size(); ++r) result_.distance[elements_[r]] = hits_[r].object < 0 ? kInfinity : std::max(hits_[r].t, 0.0f);
  }

  /// Adds what was met to what the rays have brought, and keeps those that go on.
  void addLayer() {
    size_t kept = 0;
    for (size_t r = 0; r < rays_.size(); ++r) {
      const Hit hit = hits_[r];
      if (hit.object < 0) continue;
      const int i = elements_[r];
      const vec3 color = isFinite(answers_.color[r]) ? clear_[r] * answers_.color[r] : vec3(0);
      const vec3 clear = clear_[r] * (1.0f - glm::clamp(answers_.opacity[r], 0.0f, 1.0f));
      if (result_.color.x) result_.color.x[i] += color.x, result_.color.y[i] += color.y, result_.color.z[i] += color.z;
      if (result_.opacity.x) result_.opacity.x[i] = 1 - clear.x, result_.opacity.y[i] = 1 - clear.y, result_.opacity.z[i] = 1 - clear.z;
      if (covers(clear, query_) || hit.t >= rays_[r].tMax) continue;
      rays_[kept] = behind(*tools_.rays, rays_[r], hit);
      elements_[kept] = i, clear_[kept] = clear;
      names_[kept] = {hashCombine(names_[r].key, 0x6c617965U), names_[r].sequence};
      ++kept;
    }
    rays_.resize(kept), names_.resize(kept), elements_.resize(kept), clear_.resize(kept);
  }

  const GiState& state_;
  const RayTools& tools_;
  const RayQuery& query_;
  const ShadeContext context_;
  const RayResult& result_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<SampleName> names_;
  std::vector<int> elements_;
  std::vector<vec3> clear_;
  HitAnswers answers_;
};

void clearResult(const ShadePoints& points, const uint8_t* active, const RayResult& result) {
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i]) continue;
    if (result.distance) result.distance[i] = kInfinity;
    for (const TmVec3& v : {result.color, result.opacity})
      if (v.x) v.x[i] = v.y[i] = v.z[i] = 0;
  }
}

}  // namespace

RayFilter filterOf(const RayScene& rays, const RayQuery& query, const Attributes& own) {
  return {rays.groupsIn(query.subset.empty() ? own.trace.subset : query.subset, query.excludeSubset), query.sides};
}

void setBias(const RayQuery& query, Ray& ray) {
  if (query.bias >= 0) ray.offset = 0, ray.bias = query.bias;
}

void traceForShader(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction,
                    const RayQuery& query, const ShadeContext& context, const RayResult& result) {
  clearResult(points, active, result);
  const Attributes& own = *state.scene.groups[static_cast<size_t>(points.group())].attributes;
  const ShadeContext hitContext = contextOfHits(own, query, context);
  if (context.kind == RayKind::Transmission || isTooDeep(hitContext, state.scene.options)) return;
  const RayTools* tools = state.rays();
  if (!tools) return;
  const RayFilter filter = filterOf(*tools->rays, query, own);
  ShaderRays rays(state, *tools, query, hitContext, result);
  for (int i = 0; i < points.count(); ++i) {
    const vec3 d{direction.x[i], direction.y[i], direction.z[i]};
    if (!active[i] || d == vec3(0)) continue;
    Ray ray{{P.x[i], P.y[i], P.z[i]}, d};
    aim(*tools->rays, points, i, rayTime(*tools->rays, points, i, query.number, query.count, context.seed), ray);
    ray.tMax = query.maxDistance;
    ray.offset = slantedOffset(ray.offset, std::abs(dot(d, points.get3(kNgx, i))));
    setBias(query, ray);
    ray.filter = filter.passesAll() ? nullptr : &filter;
    const SampleName name = points.name(i);
    rays.add(i, ray, {hashCombine(name.key, 0x74726163U, static_cast<uint32_t>(hitContext.depth + hitContext.specularDepth)),
                      name.sequence * static_cast<uint32_t>(query.count) + static_cast<uint32_t>(query.number)});
  }
  rays.trace();
}

}  // namespace tomales
