// Noun: what a Prim may know of its open edges beyond PatchInfo, for whoever closes the seams between surfaces that
// know nothing of each other. A shape that implements OpenBorders is found by a dynamic_cast of its Prim; of others
// nothing is known. Threads: const members may be called concurrently.
#pragma once
#include <array>
#include <optional>

#include "reyes/prim.h"

namespace tomales {

/// What belongs to the ends of an edge, of what belongs to the corners (RISpec's order), in the direction of u or v.
template <class T>
std::array<T, 2> endsOf(const std::array<T, 4>& corners, PatchEdge edge) {
  const size_t from = edge == kEdgeU1 ? 1 : edge == kEdgeV1 ? 2 : 0, to = edge == kEdgeU0 ? 2 : edge == kEdgeV0 ? 1 : 3;
  return {corners[from], corners[to]};
}

class OpenBorders {
 public:
  virtual ~OpenBorders() = default;
  /// Particles and ribbons are lone: no other surface continues them.
  virtual bool isLone() const { return false; }
  /// The ends, in the direction of u or v, of the straight line that an edge of a patch is on, in object space. The
  /// line may go on beyond the patch: its ends are points that another surface is likely to have as well. Null: the
  /// edge is not known to be straight.
  virtual std::optional<std::array<vec3, 2>> straightEdge(uint32_t /*patch*/, PatchEdge /*edge*/) const {
    return std::nullopt;
  }
};

}  // namespace tomales
