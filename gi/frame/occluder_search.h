// Private to gi: a search for occluders over a point that are nearer than anything the records that cover it have met
// (docs/decisions/0061).
#pragma once
#include "gi/gather.h"

namespace tomales {

/// Points are asked one after the other; those of a group should follow each other.
class OccluderSearch {
 public:
  OccluderSearch(const RayScene& rays, const GatherSettings& gather) : rays_(rays), gather_(gather) {}
  /// `closest`: least closest distance of the records in use at the point. `occluderHeight`: no occluder over any of
  /// them is lower.
  bool isUnderOccluder(const GatherPoint& p, float closest, float occluderHeight);
  int64_t raysTraced() const { return traced_; }

 private:
  bool meetsOccluder(const GatherPoint& p, const Ray& ray);

  const RayScene& rays_;
  const GatherSettings& gather_;
  RayFilter filter_;
  int group_ = -1;  ///< The group that filter_ belongs to.
  int64_t traced_ = 0;
};

}  // namespace tomales
