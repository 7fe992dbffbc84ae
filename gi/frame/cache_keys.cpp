#include "gi/frame/cache_keys.h"

namespace tomales {
namespace {

/// Bounces of an audit's paths where they stand for photons whose bounces nobody limits. After this many, at a
/// reflectance of 0.75, a hundredth of the light is left.
constexpr int kAuditBounces = 16;

}  // namespace

CacheSettings cacheSettings(ErrorFunction function, float maxError) {
  const ErrorFunctionInfo& info = infoOf(function);
  CacheSettings out{function, maxError > 0 ? info.kappa / maxError : kInfinity, info.maxPixels, info.minPixels,
                    info.minWeight};
  if (info.limitsFollowError) {
    out.minPixels *= maxError;
    out.minWeight /= std::max(1.0f, maxError);
  }
  return out;
}

std::vector<PreparedCache>::const_iterator preparedFor(const GiState& state, const CacheKey& key) {
  const auto find = [&](const auto& serves) { return std::ranges::find_if(state.caches, serves); };
  const auto prepared = find([&](const PreparedCache& c) { return c.key == key; });
  if (prepared != state.caches.end() || !state.cachesGiven || !(key.cache.kappa < kInfinity)) return prepared;
  const auto withOtherRays = find([&](const PreparedCache& c) {
    CacheKey same = c.key;
    same.gather.samples = key.gather.samples;
    same.gather.seed = key.gather.seed;
    return same == key;
  });
  return withOtherRays != state.caches.end()
             ? withOtherRays
             : find([&](const PreparedCache& c) { return c.key.gather.asked == key.gather.asked; });
}

bool interpolatesIndirect(const GiState& state) { return giMethodOf(state.settings.mode).caches; }

CacheKey cacheKeyFor(const GiState& state, int group, const IndirectQuery& query) {
  const Attributes& attributes = *state.scene.groups[static_cast<size_t>(group)].attributes;
  const GiSettings& settings = state.settings;
  CacheKey key;
  const float maxError =
      settings.maxError >= 0 ? settings.maxError : attributes.irradianceMaxError.value_or(query.maxError);
  key.cache = cacheSettings(settings.errorFunction.value_or(query.errorFunction), maxError);
  key.gather.curvature = infoOf(key.cache.errorFunction).needsCurvature() && maxError > 0;
  if (key.gather.curvature) key.gather.maxError = maxError;
  key.cache.maxPixels = attributes.irradianceMaxPixelDist.value_or(key.cache.maxPixels);
  key.gather.samples = std::max(1, settings.samples > 0 ? settings.samples : query.samples);
  key.gather.maxDistance = query.maxDistance;
  key.gather.seed = settings.seed;
  key.gather.subset = attributes.trace.subsetFor(query.subset);
  key.gather.indirect = bouncesFor(state, query) > 1;
  if (settings.mode == GiMode::Atlas) {
    key.gather.light = settings.storesDirect ? Illumination::Stored : Illumination::LightsAndStored;
    key.gather.specularRaysSeeLights = attributes.photon.causticMap.empty();
  }
  return key;
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

}  // namespace tomales
