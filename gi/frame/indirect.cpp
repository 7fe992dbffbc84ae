// indirectDiffuse() from the irradiance cache, and its substitutes where the cache has nothing.
#include <bit>

#include "gi/frame/state.h"
#include "gi/photons.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

// Factor on the radii of records when points are shaded. With the second-order correction, the further records remove
// more noise than they add error (docs/decisions/0103).
constexpr float kServesWider = 1.25f;
/// Bounces of an audit's paths that stand for photons whose bounces nobody limits. After so many, at a reflectance of
/// 0.75, a hundredth of the light is left.
constexpr int kAuditBounces = 16;

/// Returns E/pi of light that came by mirrors and glass, which gather rays do not find.
vec3 causticAt(const GiState& state, int group, const vec3& P, const vec3& n, float pixelSize) {
  if (state.settings.mode != GiMode::Atlas ||
      state.scene.groups[static_cast<size_t>(group)].attributes->photon.causticMap.empty())
    return vec3(0.0f);
  gatherTools(state);
  return state.atlas ? state.atlas->causticOverPi(group, P, n, 0.5f * pixelSize) : vec3(0.0f);
}

/// Returns the light of the records under the gains, or drawn anew; empty if that is their own.
std::span<const LightShare> lightOf(const GiState& state, const PreparedCache& prepared, const ShadeContext& context) {
  const auto index = static_cast<size_t>(&prepared - state.caches.data());
  if (context.redrawn && !state.redrawn.empty()) return state.redrawn[index];
  return mixedLight(state, index);
}

/// Returns a draw from the normal distribution (Box and Muller 1958) that belongs to a place.
float normalDraw(const vec3& place) {
  const uint32_t name = hashCombine(std::bit_cast<uint32_t>(place.x), std::bit_cast<uint32_t>(place.y),
                                    std::bit_cast<uint32_t>(place.z), randomStream("reca"));
  const float radius = std::sqrt(-2 * std::log(1 - unitFloat(name)));
  return radius * std::cos(2 * kPi * unitFloat(hash32(name)));
}

}  // namespace

CacheSettings cacheSettings(ErrorFunction function, float maxError) {
  const ErrorFunctionInfo& info = infoOf(function);
  CacheSettings out{function, maxError > 0 ? info.kappa / maxError : kInfinity, info.maxPixels, info.minPixels,
                    info.enough};
  if (info.limitsFollowError) {
    out.minPixels *= maxError;
    out.enough /= std::max(1.0f, maxError);
  }
  return out;
}

std::vector<PreparedCache>::const_iterator preparedFor(const GiState& state, const GatherPlan& plan) {
  const auto find = [&](const auto& serves) { return std::ranges::find_if(state.caches, serves); };
  const auto prepared = find([&](const PreparedCache& c) { return c.plan == plan; });
  if (prepared != state.caches.end() || !state.cachesGiven || !(plan.cache.kappa < kInfinity)) return prepared;
  const auto withOtherRays = find([&](const PreparedCache& c) {
    GatherPlan same = c.plan;
    same.gather.samples = plan.gather.samples;
    same.gather.seed = plan.gather.seed;
    return same == plan;
  });
  return withOtherRays != state.caches.end()
             ? withOtherRays
             : find([&](const PreparedCache& c) { return c.plan.gather.asked == plan.gather.asked; });
}

std::span<const LightShare> mixedLight(const GiState& state, size_t cache) {
  if (!state.mixed) return {};
  std::call_once(state.mixed->once, [&] {
    for (const PreparedCache& c : state.caches)
      state.mixed->ofCaches.push_back(c.plan.gather.covers() ? std::span<const LightShare>()
                                                             : c.cache.keptMix(state.gains));
  });
  return state.mixed->ofCaches[cache];
}

std::vector<LightShare> redrawn(const IrradianceCache& cache, std::span<const LightShare> mixed) {
  std::vector<LightShare> out(mixed.begin(), mixed.end());
  const IrradianceRecords& records = cache.records();
  for (size_t i = 0; i < records.size(); ++i) {
    const IrradianceRecord& r = records[i];
    if (mixed.empty()) {
      LightShare& own = out.emplace_back();
      own.E = r.E;
      std::ranges::copy(r.rotationGradient, own.rotationGradient);
      std::ranges::copy(r.translationGradient, own.translationGradient);
      std::ranges::copy(r.hessian, own.hessian);
    }
    const float light = luminance(r.E);
    if (light > 0) out[i].E *= 1 + std::sqrt(2.0f) * normalDraw(r.position) * r.noise / light;
  }
  return out;
}

const RayTools* gatherTools(const GiState& state) {
  const RayTools* tools = state.rays();
  if (tools)
    std::call_once(state.sourcesOnce, [&] {
      if (state.atlasSource) state.atlas = state.atlasSource();
      if (state.hitRadianceSource) state.hitRadiance = state.hitRadianceSource();
    });
  return tools;
}

bool interpolatesIndirect(const GiState& state) { return giMethodOf(state.settings.mode).caches; }

GatherPlan planFor(const GiState& state, int group, const IndirectQuery& query) {
  const Attributes& attributes = *state.scene.groups[static_cast<size_t>(group)].attributes;
  const GiSettings& settings = state.settings;
  GatherPlan plan;
  const float maxError =
      settings.maxError >= 0 ? settings.maxError : attributes.irradianceMaxError.value_or(query.maxError);
  plan.cache = cacheSettings(settings.errorFunction.value_or(query.errorFunction), maxError);
  plan.gather.curvature = infoOf(plan.cache.errorFunction).needsCurvature() && maxError > 0;
  if (plan.gather.curvature) plan.gather.maxError = maxError;
  plan.cache.maxPixels = attributes.irradianceMaxPixelDist.value_or(plan.cache.maxPixels);
  plan.gather.samples = std::max(1, settings.samples > 0 ? settings.samples : query.samples);
  plan.gather.maxDistance = query.maxDistance;
  plan.gather.seed = settings.seed;
  plan.gather.subset = query.subset.empty() ? attributes.trace.subset : query.subset;
  plan.gather.indirect = bouncesFor(state, query) > 1;
  if (settings.mode == GiMode::Atlas) {
    plan.gather.light = settings.storesDirect ? Illumination::Stored : Illumination::LightsAndStored;
    plan.gather.mirrored = attributes.photon.causticMap.empty();
  }
  return plan;
}

int bouncesFor(const GiState& state, const IndirectQuery& query) {
  const GiMode mode = state.settings.mode;
  const int usual = mode == GiMode::Progressive
                        ? state.shading.indirectRequest().value_or(IndirectRequest{}).bounces.value_or(kEnoughBounces)
                        : query.bounces;
  const int asked = state.settings.bounces > 0 ? state.settings.bounces : usual;
  return mode == GiMode::None ? 0 : giMethodOf(mode).hitsHoldAll ? std::min(asked, 1) : asked;
}

int auditBouncesFor(const GiState& state, const IndirectQuery& query) {
  const GiMode mode = state.settings.mode;
  if (mode != GiMode::Atlas && mode != GiMode::Progressive) return bouncesFor(state, query);
  const std::optional<int> asked = state.shading.indirectRequest().value_or(IndirectRequest{}).bounces;
  return state.settings.bounces > 0 ? state.settings.bounces : asked.value_or(kAuditBounces);
}

vec3 unitNormal(const ShadePoints& points, TmConstVec3 N, int i) {
  return normalizeOr({N.x[i], N.y[i], N.z[i]}, points.facingNormal(i));
}

void store(const IndirectResult& out, int i, const vec3& E, const vec3 dominant[3]) {
  set(out.E, i, E);
  for (int c = 0; c < 3; ++c)
    if (out.dominant[c].x) set(out.dominant[c], i, dominant[c]);
}

std::optional<vec3> gatheredOverPi(const GiState& state, const GatherPoint& at) {
  const IndirectQuery* query = state.shading.indirectQuery(at.group);
  if (!query) return std::nullopt;
  const auto prepared = preparedFor(state, planFor(state, at.group, *query));
  if (prepared == state.caches.end()) return std::nullopt;
  const IrradiancePlace place{at.position, at.normal, at.normal, at.pixelSize};
  IrradianceEstimate estimate;
  prepared->cache.lookup({&place, 1}, &estimate, kServesWider, lightOf(state, *prepared, {}));
  if (!(estimate.weight > 0)) return std::nullopt;
  return estimate.E + causticAt(state, at.group, at.position, at.normal, at.pixelSize);
}

BatchLookup placesOf(const GatherPlaces& places, const ShadePoints& points, const uint8_t* active, TmConstVec3 N) {
  BatchLookup out;
  for (int i = 0; i < points.count(); ++i)
    if (active[i]) {
      out.points.push_back(i);
      out.at.push_back(places.lookupAt(i, unitNormal(points, N, i)));
    }
  out.known.resize(out.at.size());
  return out;
}

BatchLookup lookUp(const GiState& state, const PreparedCache* prepared, const GatherPlaces& places,
                   const ShadePoints& points, const uint8_t* active, TmConstVec3 N, const ShadeContext& context) {
  BatchLookup out = placesOf(places, points, active, N);
  if (!prepared) return out;
  prepared->cache.lookup(out.at, out.known.data(), kServesWider, lightOf(state, *prepared, context));
  const auto served =
      std::count_if(out.known.begin(), out.known.end(), [](const IrradianceEstimate& e) { return e.weight > 0; });
  state.stats.irradianceCache.lookups += static_cast<int64_t>(out.at.size());
  state.stats.irradianceCache.interpolated += served;
  return out;
}

void interpolateIndirect(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                         const IndirectQuery& query, const ShadeContext& context, const IndirectResult& out) {
  GatherPlan plan = planFor(state, points.group(), query);
  const auto prepared = preparedFor(state, plan);
  plan.gather.samples = shareOfBranch(plan.gather.samples, kLeastOfHemisphere, context);
  if (context.redrawn) plan.gather.seed = hashCombine(plan.gather.seed, randomStream("alon"));
  const GatherPlaces places(state, points);
  const bool isKnown = prepared != state.caches.end(),
             keeps = isKnown && context.answers && context.answers->recordsStay && !context.redrawn;
  const BatchLookup found = keeps ? recallOrLookUp(state, *prepared, places, points, active, N, context)
                                  : lookUp(state, isKnown ? &*prepared : nullptr, places, points, active, N, context);
  for (size_t k = 0; k < found.points.size(); ++k) {
    const int i = found.points[k];
    const IrradianceEstimate& known = found.known[k];
    const vec3& n = found.at[k].shadingNormal;
    const vec3 caustic = causticAt(state, points.group(), found.at[k].position, n, found.at[k].pixelSize);
    if (known.weight > 0) {
      store(out, i, known.E + caustic, known.dominant);
      continue;
    }
    // This record stays out of the cache: other points must not find it there, as that would depend on the order of
    // shading.
    GatherPoint point = places.at(i);
    point.normal = n;
    const IndirectAnswer answer = gatherOrRecall(state, point, plan.gather, context.answers);
    store(out, i, answer.E + caustic, answer.dominant.data());
  }
}

void bounceIndirect(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                    const IndirectQuery& query, const ShadeContext& context, int bounces, const IndirectResult& out) {
  const GatherPlaces places(state, points);
  std::vector<uint8_t> unknown(active, active + points.count());
  bool all = true;
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i]) continue;
    const GatherPoint point = places.at(i);
    const IrradianceEstimate estimate =
        state.learnt->bounces.lookup(bounces - context.depth, state.camera, point.position, point.normal,
                                     places.shading(i, unitNormal(points, N, i)), context.lights);
    if (estimate.weight > 0) store(out, i, estimate.E, estimate.dominant);
    unknown[static_cast<size_t>(i)] = estimate.weight <= 0;
    all &= estimate.weight > 0;
  }
  if (!all) traceIndirect(state, points, unknown.data(), N, query, context, bounces, out);
}

}  // namespace tomales
