// Cuts one polygon into quadrilaterals without adding a point on an edge other than its midpoint. Private to
// polygons.
#pragma once
#include <array>

#include "reyes/prim.h"
#include "reyes/prim/planar.h"

namespace tomales {

/// Twice the area, towards the side from which the vertices run counter-clockwise in a right-handed space (M.
/// Newell).
glm::dvec3 newellNormal(const std::vector<vec3>& points);

/// Of the triangle that the first point makes with the one farthest from it and the one farthest from their line: a bow
/// tie, whose halves cancel each other in newellNormal(), has a plane too.
glm::dvec3 normalOfWidestTriangle(const std::vector<vec3>& points);

/// A convex part of a polygon, as positions in its list of points; an edge that is not the polygon's own is a
/// diagonal.
using Piece = std::vector<int>;

struct Pieces {
  std::vector<Piece> list;
  bool disjoint = true;  ///< At every key. False only for one that moves.
};

/// Convex parts that cover the polygon: itself, or triangles (ear clipping: Meisters 1975; of a polygon that moves,
/// corners that are ears at all keys). Never fails; where the polygon crosses itself the triangles overlap, and so they
/// do at the later keys of one that cannot be cut alike at all.
Pieces convexPieces(const Outlines& keys);

/// True if every corner turns, and turns the same way, at all keys.
bool isStrictlyConvex(const Outlines& keys);

}  // namespace tomales
