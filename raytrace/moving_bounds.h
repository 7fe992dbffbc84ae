// Boxes around what moves for rays, over the whole shutter. A ray that passes beside all of them sees the same at any
// time. Threads: const members may be called concurrently.
#pragma once
#include "raytrace/tessellate.h"
#include "raytrace/trace.h"

namespace tomales {

class MovingBounds {
 public:
  void add(const CoarseGroup& group);  ///< Pre: the group has polygons at later keys.
  bool any() const { return !boxes_.empty(); }
  /// Tells whether the part of the ray up to tMax may meet something that moves. True if in doubt.
  bool mayMeet(const Ray& ray) const;

 private:
  std::vector<Bound3> boxes_;  ///< A box for each group, or one for all if they are many.
};

}  // namespace tomales
