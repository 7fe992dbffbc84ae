// One bicubic patch in Bezier form. Private to the patch meshes.
#pragma once
#include <array>

#include "reyes/prim.h"

namespace tomales {

/// Bezier control values of one coordinate, u fastest.
using BezierNet = std::array<float, 16>;
/// x, y, z.
using BezierPatch = std::array<BezierNet, 3>;

/// Row i: the weights of four control values in Bezier control value i.
using ToBezier = std::array<std::array<float, 4>, 4>;
ToBezier bezierFrom(const Basis& basis);

BezierNet convertNet(const BezierNet& control, const ToBezier& u, const ToBezier& v);

void evaluateNet(const BezierNet& net, int n, const float* u, const float* v, float* p);
void evaluateNet(const BezierNet& net, int n, const float* u, const float* v, float* p, float* du, float* dv);

/// Positions, derivatives, and normals that are their limits where an edge has shrunk to a point.
void evaluateBicubic(const BezierPatch& patch, int n, const float* u, const float* v, SurfacePoints out);

/// The control points of the piece over the rectangle contain it.
Bound3 boundBicubic(const BezierPatch& patch, const UvRect& rect);

}  // namespace tomales
