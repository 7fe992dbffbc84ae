// Private to gi: indirect light by path tracing. Space: current. Irradiance: E/pi.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Implements indirectDiffuse(). Pre: the light may still bounce at these points.
void traceIndirect(const GiState&, const AskedPoints&, const IndirectQuery&, const ShadeContext&, int bounces,
                   const IndirectResult& out);
/// Implements ShadeServices::indirectAlong(). Pre: the same.
void traceAlong(const GiState&, const ShadePoints&, const uint8_t* active, const LobeDirection&, const IndirectQuery&,
                const ShadeContext&, int bounces, TmVec3 out);
/// Sets E/pi at points where the atlas does not tell two sides of a wall apart: by a path from each, whose hits look up
/// what is stored there.
void traceToStored(const GiState&, const ShadePoints&, const std::vector<int>& which, TmVec3 E);

}  // namespace tomales
