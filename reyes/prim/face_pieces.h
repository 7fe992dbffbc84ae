// Private to polygons: cuts one polygon into quadrilaterals. The only points that it adds to an edge are midpoints.
#pragma once
#include <array>

#include "reyes/prim.h"
#include "reyes/prim/planar.h"

namespace tomales {

/// Returns a normal as long as twice the polygon's area, on the side from which the vertices run counter-clockwise in a
/// right-handed space (M. Newell).
glm::dvec3 newellNormal(const std::vector<vec3>& points);

/// Returns the normal of one triangle of points: the first one, the one farthest from it, and the one farthest from the
/// line through these two. It gives a bow tie a plane; in newellNormal() its halves cancel each other.
glm::dvec3 normalOfWidestTriangle(const std::vector<vec3>& points);

/// A convex part of a polygon, as indices into its list of points. Edges that are not edges of the polygon are
/// diagonals.
using Piece = std::vector<int>;

struct Pieces {
  std::vector<Piece> list;
  bool disjoint = true;  ///< The parts do not overlap at any key. False only for a polygon that moves.
};

/// Returns convex parts that cover the polygon: itself, or triangles by ear clipping (Meisters 1975; for a polygon that
/// moves, corners that are ears at all keys). It never fails. The triangles overlap where the polygon crosses itself,
/// and at later keys if one cut does not suit all keys.
Pieces convexPieces(const Outlines& keys);

/// Tells whether every corner turns, and turns the same way, at all keys.
bool isStrictlyConvex(const Outlines& keys);

}  // namespace tomales
