// Private to the patch meshes: one bicubic patch in Bezier form.
#pragma once
#include <array>

#include "reyes/prim_factories.h"

namespace tomales {

/// Bezier control values of one coordinate, u fastest.
using BezierNet = std::array<float, 16>;
/// The coordinates x, y, z.
using BezierPatch = std::array<BezierNet, 3>;

/// Row i has the weights of the four control values in Bezier control value i.
using ToBezier = std::array<std::array<float, 4>, 4>;
ToBezier bezierFrom(const Basis& basis);

BezierNet convertNet(const BezierNet& control, const ToBezier& u, const ToBezier& v);

void evaluateNet(const BezierNet& net, int n, const float* u, const float* v, float* p);
void evaluateNet(const BezierNet& net, int n, const float* u, const float* v, float* p, float* du, float* dv);

/// Computes positions, derivatives and normals. Where an edge is a point, normals are limits.
void evaluateBicubic(const BezierPatch& patch, int n, const float* u, const float* v, SurfacePoints out);

/// Returns the bound of the control points of the piece over the rectangle, which contains the piece.
Bound3 boundBicubic(const BezierPatch& patch, const UvRect& rect);

}  // namespace tomales
