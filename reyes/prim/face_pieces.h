// Private to polygons: cuts one polygon into quadrilaterals. The only points that it adds to an edge are midpoints.
#pragma once
#include <array>

#include "reyes/prim.h"
#include "reyes/prim/planar.h"

namespace tomales {

/// Vector of twice the polygon's area, to the side from which the vertices run counter-clockwise in a right-handed
/// space (M. Newell).
glm::dvec3 newellNormal(const std::vector<vec3>& points);

/// Returns the same for one triangle: the first point, the point farthest from it, and the point farthest from the line
/// through these two. It gives a plane to a bow tie, whose halves cancel each other in newellNormal().
glm::dvec3 normalOfWidestTriangle(const std::vector<vec3>& points);

/// A convex part of a polygon, as positions in its list of points; edges that are not the polygon's own are diagonals.
using Piece = std::vector<int>;

struct Pieces {
  std::vector<Piece> list;
  bool disjoint = true;  ///< The parts do not overlap at any key. False only for a polygon that moves.
};

/// Returns convex parts that cover the polygon: itself, or triangles by ear clipping (Meisters 1975; for a polygon that
/// moves, corners that are ears at all keys). It never fails: where the polygon crosses itself the triangles overlap,
/// and also at later keys of a polygon that cannot be cut alike at all keys.
Pieces convexPieces(const Outlines& keys);

/// Tells whether every corner turns, and turns the same way, at all keys.
bool isStrictlyConvex(const Outlines& keys);

}  // namespace tomales
