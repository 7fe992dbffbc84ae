// What shading services do at every point of a batch for every light, in vectors. Arrays are of `n` points. `share`:
// how much of the light counts at each; where it is 0, nothing is added, whatever else a point holds. Threads: pure.
#pragma once
#include "reyes/base/math.h"
#include "reyes/shader_api.h"

namespace tomales {

/// Unit vectors; 0 where there is none. In place or not.
void normalizeAll(int n, TmConstVec3 from, TmVec3 to);
bool allFinite(int n, TmConstVec3 v);
/// facing: 1 where L lies on the side of N.
void markFacing(int n, const uint8_t* active, TmConstVec3 N, TmConstVec3 L, uint8_t* facing);
/// out += share * Cl * (L . N)
void addDiffuse(int n, const float* share, TmConstVec3 N, TmConstVec3 L, TmConstVec3 Cl, TmVec3 out);
/// out += share * Cl * (N . H)^exponent, with H half way between L and V. The power is true to 2e-6 of itself where it
/// is above 1e-3, to 2e-5 elsewhere, and 0 below 2^-126.
void addHighlight(int n, const float* share, TmConstVec3 N, TmConstVec3 V, const float* exponent, TmConstVec3 L,
                  TmConstVec3 Cl, TmVec3 out);

}  // namespace tomales
