// indirectDiffuse() from the irradiance cache, and its substitutes where the cache has nothing.
#include "gi/frame/indirect.h"
#include "gi/frame/cache_keys.h"
#include "gi/frame/recall.h"
#include "gi/frame/reference.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {

void setIndirect(const IndirectResult& out, int i, const vec3& E, const vec3 dominant[3]) {
  set(out.E, i, E);
  for (int c = 0; c < 3; ++c)
    if (out.dominant[c].x) set(out.dominant[c], i, dominant[c]);
}

void interpolateIndirect(const GiState& state, const AskedPoints& asked, const IndirectQuery& query,
                         const ShadeContext& context, const IndirectResult& out) {
  CacheKey key = cacheKeyFor(state, asked.group(), query);
  const auto prepared = preparedFor(state, key);
  key.gather.samples = shareOfBranch(key.gather.samples, kLeastOfHemisphere, context);
  if (context.redrawn) key.gather.seed = hashCombine(key.gather.seed, randomStream("alon"));
  const GatherPlaces places(state, asked.points);
  const bool isKnown = prepared != state.caches.end(),
             keeps = isKnown && context.answers && context.answers->recordsStay && !context.redrawn;
  const BatchLookup found = keeps ? recallOrLookUp(state, *prepared, places, asked, context)
                                  : lookUp(state, isKnown ? &*prepared : nullptr, places, asked, context);
  for (size_t k = 0; k < found.points.size(); ++k) {
    const int i = found.points[k];
    const IrradianceEstimate& known = found.known[k];
    const vec3& n = found.at[k].shadingNormal;
    const vec3 caustic = causticOverPi(state, asked.group(), found.at[k].position, n, found.at[k].pixelSize);
    if (known.weight > 0) {
      setIndirect(out, i, known.E + caustic, known.dominant);
      continue;
    }
    // This record stays out of the cache: other points must not find it there, as that would depend on the order of
    // shading.
    GatherPoint point = places.at(i);
    point.normal = n;
    const IndirectAnswer answer = gatherOrRecall(state, point, key.gather, context.answers);
    setIndirect(out, i, answer.E + caustic, answer.dominant.data());
  }
}

void bounceIndirect(const GiState& state, const AskedPoints& asked, const IndirectQuery& query,
                    const ShadeContext& context, int bounces, const IndirectResult& out) {
  const GatherPlaces places(state, asked.points);
  std::vector<uint8_t> unknown(asked.active, asked.active + asked.count());
  bool all = true;
  for (int i = 0; i < asked.count(); ++i) {
    if (!asked.active[i]) continue;
    const GatherPoint point = places.at(i);
    const IrradianceEstimate estimate =
        state.learnt->bounces.lookup(bounces - context.diffuseDepth, state.camera, point.position, point.normal,
                                     places.shading(i, asked.normal(i)), context.onlyLightGroup);
    if (estimate.weight > 0) setIndirect(out, i, estimate.E, estimate.dominant);
    unknown[static_cast<size_t>(i)] = estimate.weight <= 0;
    all &= estimate.weight > 0;
  }
  if (!all) traceIndirect(state, {asked.points, unknown.data(), asked.N}, query, context, bounces, out);
}

}  // namespace tomales
