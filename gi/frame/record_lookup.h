// Private to gi: what the records of a frame answer at the points of a batch. Space: current. Irradiance: E/pi.
#pragma once
#include "gi/frame/gather_places.h"

namespace tomales {

/// The answers of records at the active points of a batch.
struct BatchLookup {
  std::vector<int> points;                ///< Indices of the points in the batch.
  std::vector<IrradiancePlace> at;        ///< The places where they look.
  std::vector<IrradianceEstimate> known;  ///< The answers; their weight is 0 where no record serves.
};

/// prepared: one of state.caches, or null, which knows nothing. Counts lookups and hits.
BatchLookup lookUp(const GiState&, const PreparedCache* prepared, const GatherPlaces&, const AskedPoints&,
                   const ShadeContext&);

/// Returns the places where the active points look, with no answer yet.
BatchLookup placesOf(const GatherPlaces&, const AskedPoints&);

/// Returns the light of a cache's records under the gains; empty if the gains do not change it.
std::span<const IrradianceExpansion> mixedLight(const GiState&, size_t cache);

/// Returns the light of a cache's records as it would be with other random numbers. Each record is made brighter or
/// darker by a draw of its noise, times the root of 2, because that is how much two independent pictures differ. mixed:
/// mixedLight() of the cache.
std::vector<IrradianceExpansion> redrawn(const IrradianceCache&, std::span<const IrradianceExpansion> mixed);

/// Returns E/pi of light that came by mirrors and glass, which gather rays do not find. n: unit normal.
vec3 causticOverPi(const GiState&, int group, const vec3& P, const vec3& n, float pixelSize);

/// Returns E/pi that the gather pass has left at a place; empty where no record serves.
std::optional<vec3> gatheredOverPi(const GiState&, const GatherPoint& at);

}  // namespace tomales
