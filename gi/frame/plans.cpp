#include "gi/frame/plans.h"

namespace tomales {
namespace {

/// Bounces of an audit's paths that stand for photons whose bounces nobody limits. After so many, at a reflectance of
/// 0.75, a hundredth of the light is left.
constexpr int kAuditBounces = 16;

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

}  // namespace tomales
