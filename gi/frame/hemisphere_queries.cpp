// Answers occlusion() and indirectdiffuse() of shaders from records, as the irradiance cache does. For occlusion()
// these hold the uncovered share of the hemisphere instead of light.
#include "gi/frame/hemisphere_queries.h"
#include "gi/frame/cache_keys.h"
#include "gi/frame/recall.h"
#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

/// Least number of rays of a record. Many points share a record, so its noise would show as blotches.
constexpr int kLeastOfRecord = 256;
/// Points of a group at which its shaders are run to learn their queries. A shader may ask at some of its points alone.
constexpr size_t kExamples = 4;

/// A visible point at which the shaders of its group are run.
struct Example {
  uint32_t order;  ///< The points with the least numbers of a group are taken, whatever the tiles are.
  ShadePoints point;
};

ShadePoints onePoint(const ShadePoints& batch, int i) {
  ShadePoints one(batch.group(), batch.primvarFloats(), batch.hasSteps());
  one.assign(batch, i, i + 1);
  return one;
}

/// Keeps the first examples in their order. A point that several tiles see counts once.
void add(std::vector<Example>& known, const ShadePoints& batch) {
  for (int i = 0; i < batch.count(); ++i) {
    const uint32_t order = hash32(batch.key(i));
    const auto at = std::ranges::lower_bound(known, order, {}, &Example::order);
    if (at - known.begin() >= static_cast<std::ptrdiff_t>(kExamples) || (at != known.end() && at->order == order))
      continue;
    known.insert(at, {order, onePoint(batch, i)});
    if (known.size() > kExamples) known.pop_back();
  }
}

std::vector<std::vector<Example>> examplesOf(const GiState& state, const DeepFrame& layout, const TileReader& tiles,
                                             StopToken stop) {
  std::vector<std::vector<Example>> examples(state.scene.groups.size());
  std::mutex merging;
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const auto tile = stop.requested() ? nullptr : tiles(t);
    if (!tile) return;
    const std::lock_guard lock(merging);
    for (const ShadePoints& batch : tile->batches)
      if (state.shading.group(batch.group()).asksHemispheres())
        add(examples[static_cast<size_t>(batch.group())], batch);
  });
  return examples;
}

}  // namespace

void learnHemisphereQueries(GiState& state, const DeepFrame& layout, const TileReader& tiles, StopToken stop) {
  state.hemispheresAsked.assign(state.scene.groups.size(), {});
  bool any = false;
  for (size_t g = 0; g < state.scene.groups.size(); ++g)
    any |= state.shading.group(static_cast<int>(g)).asksHemispheres();
  if (!any || !keepsHemispheres(state.settings)) return;
  ShadeContext context;
  context.purpose = Purpose::Rehearsal;
  context.indirect = false;
  context.seed = state.settings.seed;
  const std::vector<std::vector<Example>> examples = examplesOf(state, layout, tiles, stop);
  parallelFor(examples.size(), 1, [&](size_t g, size_t) {
    for (const Example& e : examples[g]) {
      ShadedPoints out;
      state.shading.shade(e.point, context, out);
    }
  });
}

CacheKey cacheKeyFor(const GiState& state, int group, const HemisphereQuery& query) {
  CacheKey key;
  const float maxError = state.settings.maxError > 0 ? state.settings.maxError : query.maxVariation / kVariationOfError;
  key.cache = query.radiance ? cacheSettings(ErrorFunction::Hessian, maxError)
                             : CacheSettings{.errorFunction = ErrorFunction::Hessian};
  key.cache.maxPixels = state.scene.groups[static_cast<size_t>(group)].attributes->irradianceMaxPixelDist.value_or(
      infoOf(ErrorFunction::Hessian).maxPixels);
  key.gather.curvature = true;
  if (query.radiance) key.gather.maxError = maxError;
  key.gather.samples = std::max(query.samples, kLeastOfRecord);
  key.gather.maxDistance = query.maxDistance;
  key.gather.seed = state.settings.seed;
  key.gather.asked = query;
  return key;
}

bool interpolateHemisphere(const GiState& state, const AskedPoints& asked, const HemisphereQuery& query,
                           const ShadeContext& context, TmVec3 out) {
  if (!keepsHemispheres(state.settings)) return false;
  if (context.purpose == Purpose::Rehearsal) {
    auto& known = state.hemispheresAsked[static_cast<size_t>(asked.group())];
    if (std::find(known.begin(), known.end(), query) == known.end()) known.push_back(query);
    return true;
  }
  // Records without shares do not know whose light they hold.
  if (query.radiance && context.onlyLightGroup && state.groups.empty()) return false;
  CacheKey key = cacheKeyFor(state, asked.group(), query);
  const auto prepared = preparedFor(state, key);
  if (prepared == state.caches.end()) return false;
  if (context.redrawn) key.gather.seed = hashCombine(key.gather.seed, randomStream("alon"));
  const GatherPlaces places(state, asked.points);
  const BatchLookup found = lookUp(state, &*prepared, places, asked, context);
  for (size_t k = 0; k < found.points.size(); ++k) {
    const int i = found.points[k];
    vec3 E = found.known[k].E;
    if (!(found.known[k].weight > 0)) {
      GatherPoint point = places.at(i);
      point.normal = found.at[k].shadingNormal;
      E = gatherOrRecall(state, point, key.gather, context.answers).E;
    }
    set(out, i, query.radiance ? glm::max(E, vec3(0)) : glm::clamp(1.0f - E, 0.0f, 1.0f));
  }
  return true;
}

}  // namespace tomales
