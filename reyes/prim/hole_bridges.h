// Joins the holes of a polygon to its outline. Private to polygons.
#pragma once
#include "reyes/prim.h"

namespace tomales {

/// One closed walk over a polygon with holes.
struct BridgedOutline {
  std::vector<int> order;  ///< Positions in the list of points; both ends of a bridge come twice.
  int ignored = 0;         ///< Holes that lie outside of the outline.
};

/// Loop k is points[loopStarts[k]] to points[loopStarts[k + 1] - 1]: first the outline, which goes
/// counter-clockwise about the normal, then the holes, which go either way.
BridgedOutline bridgeHoles(const std::vector<vec3>& points, const std::vector<int>& loopStarts,
                           const glm::dvec3& normal);

}  // namespace tomales
