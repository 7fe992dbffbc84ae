// Private to the primitives: arithmetic that several of them share.
#pragma once
#include <array>
#include <utility>

#include "reyes/prim.h"

namespace tomales {

/// Indices of elements at a patch's corners (u,v) = (0,0), (1,0), (0,1), (1,1): RISpec's order.
using Corners = std::array<uint32_t, 4>;

/// Writes component c of point i to out[c * stride + i]. Weights are (1-u) and u, so that both sides of an edge, which
/// run in opposite directions, add the same two products.
void interpolateBilinear(const float* values, int width, const Corners& corners, int n, const float* u, const float* v,
                         float* out, int stride);

/// Repeats one element n times.
void repeatElement(const float* element, int width, int n, float* out, int stride);

/// If the primvar has one value all over a patch (storage constant, or uniform: that of element `uniform`), fills `out`
/// with it and returns true.
bool repeatIfEven(const Primvar& var, size_t uniform, int n, float* out, int stride);

/// Fills positions and derivatives, and normals as their cross product.
void evaluateBilinear(const std::array<vec3, 4>& corners, int n, const float* u, const float* v, SurfacePoints out);

/// Returns the bound over the rectangle: four corners are the hull of a piece of a bilinear patch.
Bound3 boundBilinear(const std::array<vec3, 4>& corners, const UvRect& rect);

/// Sets the normals to dPdu x dPdv.
void crossDerivatives(int n, SurfacePoints points);

/// Grows a bound by the rounding of arithmetic on numbers as large as the coordinates of `whole`.
Bound3 paddedForRounding(const Bound3& bound, const Bound3& whole);

inline void setFrame(SurfacePoints points, int i, const vec3& p, const vec3& du, const vec3& dv) {
  points.px[i] = p.x;
  points.py[i] = p.y;
  points.pz[i] = p.z;
  points.dux[i] = du.x;
  points.duy[i] = du.y;
  points.duz[i] = du.z;
  points.dvx[i] = dv.x;
  points.dvy[i] = dv.y;
  points.dvz[i] = dv.z;
}
inline void setNormal(SurfacePoints points, int i, const vec3& normal) {
  points.nx[i] = normal.x;
  points.ny[i] = normal.y;
  points.nz[i] = normal.z;
}
inline vec3 normalOf(SurfacePoints points, int i) { return {points.nx[i], points.ny[i], points.nz[i]}; }

/// Returns a normal, of any length, for a point (u,v) where the derivatives are parallel or zero, for example where an
/// edge is a point. It is the normal of a point slightly nearer to the middle of the patch. derivativesAt(u, v) returns
/// dPdu and dPdv as a pair of vectors of Real. Of three steps towards the middle it takes the smallest at which the
/// sine of the angle between the derivatives exceeds `leastSine`, so that rounding does not turn the normal: 1e-4 for
/// derivatives in single precision, whose rounding error of 6e-8 grows in differences of near numbers; 1e-6 for
/// derivatives in double precision of control points in single precision. Returns (0, 0, 1) if no step helps.
template <class Real, class DerivativesAt>
glm::vec<3, Real> normalNearby(Real u, Real v, Real leastSine, const DerivativesAt& derivativesAt) {
  for (const Real step : {Real(1e-3), Real(1e-2), Real(1e-1)}) {
    const auto [du, dv] = derivativesAt(u + (Real(0.5) - u) * step, v + (Real(0.5) - v) * step);
    const glm::vec<3, Real> normal = glm::cross(du, dv);
    if (glm::length(normal) > leastSine * glm::length(du) * glm::length(dv)) return normal;
  }
  return {0, 0, 1};
}

}  // namespace tomales
