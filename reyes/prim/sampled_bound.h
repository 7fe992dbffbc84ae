// Private to the primitives: a box around a smooth piece of surface that can only be sampled at points.
#pragma once
#include "reyes/prim.h"

namespace tomales {

/// Returns the bound of samples of the piece, grown by the distance that it can bulge between them. positionAt(u, v)
/// returns a point of the surface. Where curvature is even, a function differs from its linear interpolant by an eighth
/// of the second difference. Four times that is allowed in each direction, because curvature is not even next to a
/// crease.
template <class PositionAt>
Bound3 boundOfSamples(const UvRect& rect, const PositionAt& positionAt) {
  constexpr int kSide = 5;
  Bound3 bound;
  vec3 p[kSide][kSide];
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const float a = static_cast<float>(i) / (kSide - 1), b = static_cast<float>(j) / (kSide - 1);
      p[j][i] = positionAt(lerp(rect.u0, rect.u1, a), lerp(rect.v0, rect.v1, b));
      bound.extend(p[j][i]);
    }
  vec3 bendU(0), bendV(0);
  for (int j = 0; j < kSide; ++j)
    for (int i = 1; i + 1 < kSide; ++i) {
      bendU = glm::max(bendU, glm::abs(p[j][i - 1] - 2.0f * p[j][i] + p[j][i + 1]));
      bendV = glm::max(bendV, glm::abs(p[i - 1][j] - 2.0f * p[i][j] + p[i + 1][j]));
    }
  const vec3 bulge = 0.5f * (bendU + bendV);
  return {bound.lo - bulge, bound.hi + bulge};
}

}  // namespace tomales
