// The computations of shading services at every point of a batch for every light, vectorised. Arrays have `n` elements.
// `share` is the share of the light that counts at a point. Where it is 0, nothing is added, even if other values are
// NaN. Threads: pure.
#pragma once
#include "reyes/base/math.h"
#include "reyes/shader_api.h"

namespace tomales {

/// Makes unit vectors, and leaves zero vectors 0. `to` may be `from`.
void normalizeAll(int n, TmConstVec3 from, TmVec3 to);
bool allFinite(int n, TmConstVec3 v);
/// Sets facing to 1 where L lies on the side of N.
void markFacing(int n, const uint8_t* active, TmConstVec3 N, TmConstVec3 L, uint8_t* facing);
/// Adds share * Cl * (L . N) to `out`.
void addDiffuse(int n, const float* share, TmConstVec3 N, TmConstVec3 L, TmConstVec3 Cl, TmVec3 out);
/// Adds share * Cl * (N . H)^exponent to `out`, with H half way between L and V. The relative error of the power is
/// 2e-6 where it is above 1e-3, and 2e-5 elsewhere; below 2^-126 it is 0.
void addHighlight(int n, const float* share, TmConstVec3 N, TmConstVec3 V, const float* exponent, TmConstVec3 L,
                  TmConstVec3 Cl, TmVec3 out);

}  // namespace tomales
