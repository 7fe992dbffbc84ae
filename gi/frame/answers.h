// Private to gi: the answers to what shaders ask, by the method of the frame. GiServices chooses among them.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Writes E/pi and dominant directions to element i of a result.
void store(const IndirectResult& out, int i, const vec3& E, const vec3 dominant[3]);

/// Implements indirectDiffuse() in GiMode::Baked, at any depth.
void bakedIndirect(const GiState&, const ShadePoints&, const uint8_t* active, const IndirectResult& out);

// Implements indirectDiffuse() in the other modes. Pre: the light may still bounce at these points.
void interpolateIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                         const ShadeContext&, const IndirectResult& out);
void traceIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                   const ShadeContext&, int bounces, const IndirectResult& out);
/// Implements ShadeServices::indirectAlong(); likewise.
void traceAlong(const GiState&, const ShadePoints&, const uint8_t* active, const LobeDirection&, const IndirectQuery&,
                const ShadeContext&, int bounces, TmVec3 out);
/// Sets E/pi at points where the atlas does not tell two sides of a wall apart: by a path from each, whose hits look up
/// what is stored there.
void traceToStored(const GiState&, const ShadePoints&, const std::vector<int>& which, TmVec3 E);
/// Implements ShadeServices::interpolatedHemisphere().
bool interpolateHemisphere(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N,
                           const HemisphereQuery&, const ShadeContext&, TmVec3 out);
/// Implements indirectDiffuse() at hits of gather rays: from the caches of further bounces, or traced.
void bounceIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                    const ShadeContext&, int bounces, const IndirectResult& out);

}  // namespace tomales
