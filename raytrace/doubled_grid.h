// A grid diced at twice the rate of the polygons that rays see: every second vertex is a corner of a polygon, and the
// vertices between show how far it is from the surface.
#pragma once
#include "reyes/grid.h"

namespace tomales {

bool isFinite(const Grid& grid);  ///< Tells whether its positions are finite at all motion keys.

/// Deviation of the polygon with corner (i, j) at a motion key: the greatest distance of the surface's centre and edge
/// middles from the polygon, across its plane. Along the plane a point may slide without leaving the surface.
float doubledDeviation(const Grid& grid, int key, int i, int j);
float doubledDeviation(const Grid& grid, int key);  ///< The largest deviation of all polygons.

}  // namespace tomales
