// A grid diced at twice the rate of the polygons that rays see: every second vertex is a corner of one, and those
// between say how far it is off.
#pragma once
#include "reyes/grid.h"

namespace tomales {

bool isFinite(const Grid& grid);  ///< At all motion keys.

/// Of the polygon with corner (i, j), at a motion key: distance of the centre and the middles of the edges from it,
/// across its plane; along the plane a point may slide without leaving the surface.
float doubledDeviation(const Grid& grid, int key, int i, int j);
float doubledDeviation(const Grid& grid, int key);  ///< The largest of all polygons.

}  // namespace tomales
