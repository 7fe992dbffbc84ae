// Rays that shaders ask for: one from each point of a batch, their hits shaded together.
#include "gi/frame/ray_calls.h"

#include "gi/frame/ray_start.h"
#include "gi/gather/layers.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr int kMostBranches = 1 << 14;

bool isTooDeep(const ShadeContext& hit, const Options& options) {
  const bool past =
      hit.kind == RayKind::Diffuse ? hit.diffuseDepth > hit.diffuseLimit : hit.specularDepth > hit.specularLimit;
  return past || hit.kind == RayKind::Transmission || hit.diffuseDepth + hit.specularDepth > options.maxRayDepth;
}

/// The rays of one call, layer by layer.
class ShaderRays {
 public:
  ShaderRays(const GiState& state, const RayTools& tools, const RayQuery& query, const ShadeContext& hitContext,
             const RayResult& result)
      : state_(state), tools_(tools), query_(query), context_(hitContext), result_(result) {}

  void add(int element, const Ray& ray, SampleName name) {
    layers_.add(element, ray, name);
    if (result_.effective) covered_[element].start = ray.origin;
  }

  void trace() {
    const bool wantsColor = result_.color.x || result_.opacity.x;
    for (int layer = 0; layer < (wantsColor ? kMostLayers : 1) && !layers_.rays.empty(); ++layer) {
      meet();
      setLeaves();
      const HitQuestion question{.mode = query_.mode,
                                 .wantsColor = wantsColor || asksForSurface(),
                                 .outputs = layer == 0 ? result_.outputs : std::vector<RayOutput>{},
                                 .elements = layers_.elements};
      if (question.wantsColor || !question.outputs.empty())
        tools_.rays->shadeHits(layers_.rays, hits_, layers_.names, *tools_.shading, context_, question, answers_);
      if (layer == 0)
        setDistances();  // the shader's own surface accounts for the volume before the first hit
      else
        tools_.rays->crossVolumes(layers_.came, layers_.left, layers_.rays, hits_, layers_.names, *tools_.shading,
                                  context_, answers_);
      if (wantsColor)
        tools_.rays->throughVolumes(layers_.rays, hits_, layers_.names, mask(), *tools_.shading, context_, answers_);
      if (result_.effective) addCovered();
      if (wantsColor)
        layers_.goOn(*tools_.rays, hits_, answers_, query_.opacityThreshold,
                     [&](int i, const vec3& color, const vec3& transmittance) { add(i, color, transmittance); });
    }
    for (const auto& [i, c] : covered_) result_.effective[i] = c.share > 0 ? c.distance / c.share : kInfinity;
  }

 private:
  RayMask mask() const { return query_.kind == RayKind::Diffuse ? kMaskDiffuse : kMaskSpecular; }
  void meet() {
    const bool diffuse = query_.kind == RayKind::Diffuse;
    state_.stats.rays.hitlistAdjusted += layers_.meet(*tools_.rays, mask(), hits_);
    (diffuse ? state_.stats.rays.gather : state_.stats.rays.specular) += static_cast<int64_t>(layers_.rays.size());
  }

  bool asksForSurface() const {
    return std::any_of(result_.outputs.begin(), result_.outputs.end(),
                       [](const RayOutput& o) { return o.name.starts_with("surface:"); });
  }

  void setDistances() {
    if (!result_.distance) return;
    for (size_t r = 0; r < hits_.size(); ++r)
      result_.distance[layers_.elements[r]] = hits_[r].object < 0 ? kInfinity : std::max(hits_[r].t, 0.0f);
  }

  void setLeaves() {
    if (!result_.leaves) return;
    for (size_t r = 0; r < hits_.size(); ++r)
      if (hits_[r].object < 0) result_.leaves[layers_.elements[r]] = 1;
  }

  void addCovered() {
    for (size_t r = 0; r < hits_.size(); ++r) {
      if (hits_[r].object < 0) continue;
      Covered& c = covered_[layers_.elements[r]];
      const vec3 covers = layers_.transmittance[r] * glm::clamp(answers_.opacity[r], 0.0f, 1.0f),
                 end = layers_.rays[r].origin + hits_[r].t * layers_.rays[r].direction;
      const float share = (covers.x + covers.y + covers.z) / 3;
      c.share += share;
      c.distance += share * glm::length(end - c.start);
    }
  }

  void add(int i, const vec3& color, const vec3& transmittance) {
    if (result_.color.x) set(result_.color, i, get(result_.color, i) + color);
    if (result_.opacity.x) set(result_.opacity, i, 1.0f - transmittance);
  }

  const GiState& state_;
  const RayTools& tools_;
  const RayQuery& query_;
  const ShadeContext context_;
  const RayResult& result_;
  RayLayers layers_;
  std::vector<Hit> hits_;
  HitAnswers answers_;
  /// The opacity at which a ray ends, surface by surface, and the distances weighted by it.
  struct Covered {
    vec3 start{0.0f};
    float share = 0, distance = 0;
  };
  std::map<int, Covered> covered_;  ///< Indexed by element, where `effective` is wanted.
};

void clearResult(const ShadePoints& points, const uint8_t* active, const RayResult& result) {
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i]) continue;
    if (result.distance) result.distance[i] = kInfinity;
    if (result.leaves) result.leaves[i] = 0;
    if (result.effective) result.effective[i] = kInfinity;
    for (const TmVec3& v : {result.color, result.opacity})
      if (v.x) v.x[i] = v.y[i] = v.z[i] = 0;
  }
}

}  // namespace

// The limits of an object count from the depth of its own point, and never raise those that the ray came with.
std::optional<ShadeContext> contextOfHits(const GiState& state, const ShadePoints& points, const RayQuery& query,
                                          const ShadeContext& context) {
  const Attributes& own = *state.scene.groups[static_cast<size_t>(points.group())].attributes;
  ShadeContext hit = context;
  const bool byPaths = state.settings.mode == GiMode::Reference || context.auditPaths > 0;
  hit.highlights = byPaths ? HitHighlights::All : HitHighlights::None;
  hit.kind = query.kind;
  hit.label = query.label;
  hit.seesAreaLights = query.seesAreaLights && context.seesLightsInMirrors(points.group());
  hit.importance *= query.importance;
  hit.diffuseLimit = std::min(context.diffuseLimit, context.diffuseDepth + own.trace.maxDiffuseDepth);
  hit.specularLimit = std::min(context.specularLimit, context.specularDepth + own.trace.maxSpecularDepth);
  if (query.kind == RayKind::Diffuse) {
    ++hit.diffuseDepth;
    hit.lightSamples = 1;
    hit.indirect = byPaths;
  } else {
    ++hit.specularDepth;
    hit.branches = std::min(hit.branches * query.count, kMostBranches);
  }
  if (context.purpose == Purpose::Rehearsal || context.kind == RayKind::Transmission ||
      isTooDeep(hit, state.scene.options))
    return std::nullopt;
  return hit;
}

RayFilter filterOf(const RayScene& rays, const RayQuery& query, const Attributes& own) {
  return {rays.groupsIn(own.trace.subsetFor(query.subset), query.excludeSubset), query.sides};
}

void setBias(const RayQuery& query, Ray& ray) {
  if (query.bias >= 0) {
    ray.offset = 0;
    ray.bias = query.bias;
  }
}

void traceForShader(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 P,
                    TmConstVec3 direction, const RayQuery& query, const ShadeContext& context,
                    const RayResult& result) {
  clearResult(points, active, result);
  const std::optional<ShadeContext> ofHits = contextOfHits(state, points, query, context);
  if (!ofHits) return;
  const RayTools* tools = state.rays();
  if (!tools) return;
  const Attributes& own = *state.scene.groups[static_cast<size_t>(points.group())].attributes;
  const RayFilter filter = filterOf(*tools->rays, query, own);
  ShaderRays rays(state, *tools, query, *ofHits, result);
  for (int i = 0; i < points.count(); ++i) {
    const vec3 d{direction.x[i], direction.y[i], direction.z[i]};
    if (!active[i] || d == vec3(0)) continue;
    Ray ray{{P.x[i], P.y[i], P.z[i]}, d};
    if (query.radius) {
      ray.radius = query.radius[i];
      ray.spread = query.spread[i];
    }
    startRay(*tools->rays, points, i, rayTime(*tools->rays, points, i, query.number, query.count, context.seed), ray);
    ray.tMax = query.maxDistance;
    ray.offset = slantedOffset(ray.offset, std::abs(dot(d, points.get3(kNgx, i))));
    setBias(query, ray);
    ray.filter = filter.passesAll() ? nullptr : &filter;
    const SampleName name = points.name(i);
    rays.add(i, ray,
             {hashCombine(name.key, randomStream("trac"),
                          static_cast<uint32_t>(ofHits->diffuseDepth + ofHits->specularDepth)),
              name.sequence * static_cast<uint32_t>(query.count) + static_cast<uint32_t>(query.number)});
  }
  rays.trace();
}

bool crossVolumesBefore(const GiState& state, const ShadePoints& points, const ShadeContext& context,
                        ShadedPoints& out) {
  const RayTools* tools = state.rays();
  if (!tools || !tools->rays->hasVolumes()) return false;
  std::vector<Ray> rays;
  std::vector<SampleName> names;
  for (int i = 0; i < points.count(); ++i) {
    const vec3 I = points.get3(kIx, i), eye = points.position(i) - I;
    rays.push_back({.origin = eye, .direction = normalizeOr(I, vec3(0, 0, 1)), .tMax = glm::length(I)});
    rays.back().time = points.channel(kTime)[i];
    names.push_back(points.name(i));
  }
  const std::vector<Hit> nothing(rays.size());  // all rays end at their tMax
  HitAnswers answers;
  answers.color.assign(rays.size(), vec3(0));
  answers.opacity.assign(rays.size(), vec3(0));
  tools->rays->throughVolumes(rays, nothing, names, kMaskCamera, *tools->shading, context, answers);
  out.resize(points.count());
  for (int i = 0; i < points.count(); ++i)
    out.set(i, answers.color[static_cast<size_t>(i)], answers.opacity[static_cast<size_t>(i)]);
  return true;
}

}  // namespace tomales
