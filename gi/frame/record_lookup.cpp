#include "gi/frame/record_lookup.h"

#include <bit>

#include "gi/frame/cache_keys.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

// Factor on the radii of records when points are shaded. With the second-order correction, the further records remove
// more noise than they add error (docs/decisions/0103).
constexpr float kServesWider = 1.25f;

/// Returns the light of the records under the gains, or drawn anew; empty if the records' own light is meant.
std::span<const IrradianceExpansion> lightOf(const GiState& state, const PreparedCache& prepared,
                                             const ShadeContext& context) {
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

vec3 causticOverPi(const GiState& state, int group, const vec3& P, const vec3& n, float pixelSize) {
  if (state.settings.mode != GiMode::Atlas ||
      state.scene.groups[static_cast<size_t>(group)].attributes->photon.causticMap.empty())
    return vec3(0.0f);
  gatherTools(state);
  return state.atlas ? state.atlas->causticOverPi(group, P, n, 0.5f * pixelSize) : vec3(0.0f);
}

std::span<const IrradianceExpansion> mixedLight(const GiState& state, size_t cache) {
  if (!state.mixed) return {};
  std::call_once(state.mixed->once, [&] {
    for (const PreparedCache& c : state.caches)
      state.mixed->ofCaches.push_back(c.key.gather.isOcclusion() ? std::span<const IrradianceExpansion>()
                                                                 : c.cache.cachedMix(state.gains));
  });
  return state.mixed->ofCaches[cache];
}

std::vector<IrradianceExpansion> redrawn(const IrradianceCache& cache, std::span<const IrradianceExpansion> mixed) {
  std::vector<IrradianceExpansion> out(mixed.begin(), mixed.end());
  const IrradianceRecords& records = cache.records();
  for (size_t i = 0; i < records.size(); ++i) {
    const IrradianceRecord& r = records[i];
    if (mixed.empty()) out.push_back(r.light);
    const float light = luminance(r.light.E);
    if (light > 0) out[i].E *= 1 + std::sqrt(2.0f) * normalDraw(r.position) * r.noise / light;
  }
  return out;
}

std::optional<vec3> gatheredOverPi(const GiState& state, const GatherPoint& at) {
  const IndirectQuery* query = state.shading.group(at.group).indirectQuery();
  if (!query) return std::nullopt;
  const auto prepared = preparedFor(state, cacheKeyFor(state, at.group, *query));
  if (prepared == state.caches.end()) return std::nullopt;
  const IrradiancePlace place{at.position, at.normal, at.normal, at.pixelSize};
  IrradianceEstimate estimate;
  prepared->cache.lookup({&place, 1}, &estimate, kServesWider, lightOf(state, *prepared, {}));
  if (!(estimate.weight > 0)) return std::nullopt;
  return estimate.E + causticOverPi(state, at.group, at.position, at.normal, at.pixelSize);
}

BatchLookup placesOf(const GatherPlaces& places, const AskedPoints& asked) {
  BatchLookup out;
  for (int i = 0; i < asked.count(); ++i)
    if (asked.active[i]) {
      out.points.push_back(i);
      out.at.push_back(places.lookupAt(i, asked.normal(i)));
    }
  out.known.resize(out.at.size());
  return out;
}

BatchLookup lookUp(const GiState& state, const PreparedCache* prepared, const GatherPlaces& places,
                   const AskedPoints& asked, const ShadeContext& context) {
  BatchLookup out = placesOf(places, asked);
  if (!prepared) return out;
  prepared->cache.lookup(out.at, out.known.data(), kServesWider, lightOf(state, *prepared, context));
  const auto served =
      std::count_if(out.known.begin(), out.known.end(), [](const IrradianceEstimate& e) { return e.weight > 0; });
  state.stats.irradianceCache.lookups += static_cast<int64_t>(out.at.size());
  state.stats.irradianceCache.interpolated += served;
  return out;
}

}  // namespace tomales
