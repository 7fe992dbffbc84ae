// Private to the primitives: arithmetic that several of them share.
#pragma once
#include <array>

#include "reyes/prim.h"

namespace tomales {

/// Element numbers at a patch's corners (u,v) = (0,0), (1,0), (0,1), (1,1): RISpec's order.
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

}  // namespace tomales
