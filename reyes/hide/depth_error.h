// Private to the hider: how far depth keys may be wrong.
#pragma once
#include <cmath>

#include "reyes/hide/subpixel.h"

namespace tomales {

/// Relative error of the depth key of a sample on a given micropolygon. It is interpolated in about seven operations in
/// single precision, and each rounds by up to 2^-24 = 6e-8.
constexpr float kInterpolatedDepthError = 4e-7f;
/// Relative difference of depth keys within which cells of two grids may be one surface. Their vertices are evaluated,
/// displaced and projected separately, so many more roundings add up. It is 25 times the error above.
constexpr float kJoinedDepthError = 1e-5f;

/// Returns the error bound of a depth key. It is above 0, because vertices lie on the lattice and numbers are floats.
/// `slope` is the change of the depth key across a pixel.
inline float depthErrorBound(float slope, float depth) {
  return slope / kSubpixels + kInterpolatedDepthError * std::abs(depth) + kTiny;
}

}  // namespace tomales
