// Private to gi: an amendment of the irradiance cache (gi/cache/amendments/switches.h). Under a surface that lies close
// over a point, light changes over the height of that surface, whatever the size of a pixel. So a record reaches no
// farther than an occluder over it is high, and a point under an occluder that no record in use has met gets a record
// of its own. Without this amendment, slots narrower than a pixel get the light in front of them: a tenth of the error
// of all scenes comes from there, and a third of the error at a lamp's slot. It costs a tenth more records and a tenth
// more time (docs/decisions/0061).
#pragma once
#include "gi/gather.h"
#include "gi/gather/hemisphere.h"

namespace tomales {

/// Returns the validity radius under a nearby occluder: the height below which a tenth of the nearly upright rays end,
/// so that a hair does not count. It is at least a quarter of a pixel. `upright`: memory that may be used.
float radiusUnderOccluder(const HemisphereSamples& samples, float pixelSize, std::vector<float>& upright);

/// Searches for occluders. Points are asked one after the other; those of a group should follow each other.
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
