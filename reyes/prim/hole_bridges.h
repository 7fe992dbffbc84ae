// Private to polygons: joins the holes of a polygon to its outline.
#pragma once
#include "reyes/prim/planar.h"

namespace tomales {

/// One closed walk over a polygon with holes.
struct BridgedOutline {
  std::vector<uint32_t> order;  ///< Indices into the list of points; both ends of a bridge occur twice.
  int ignored = 0;              ///< Number of holes that lie outside of the outline.
  bool simple = true;           ///< No bridge crosses anything at any key. False only for a polygon that moves.
};

/// Loop k is the points loopStarts[k] to loopStarts[k + 1] - 1: first the outline, which goes counter-clockwise, then
/// the holes, which may go either way. Bridges are chosen at the first key unless they are blocked at another.
BridgedOutline bridgeHoles(const Outlines& keys, const std::vector<int>& loopStarts);

}  // namespace tomales
