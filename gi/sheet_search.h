// Private to gi: sheets that lie over points nearer than the records that cover these have met anything
// (docs/decisions/0061).
#pragma once
#include "gi/gather.h"

namespace tomales {

/// For points that come one after the other, those of a group together.
class SheetSearch {
 public:
  SheetSearch(const RayScene& rays, const GatherSettings& gather) : rays_(rays), gather_(gather) {}
  /// `closest`: that any record in use at the point has met; `headroom`: no sheet over any of them is lower.
  bool isUnderSheet(const GatherPoint& p, float closest, float headroom);
  int64_t raysTraced() const { return traced_; }

 private:
  bool meetsSheet(const GatherPoint& p, const Ray& ray);

  const RayScene& rays_;
  const GatherSettings& gather_;
  RayFilter filter_;
  int group_ = -1;  ///< Whose filter that is.
  int64_t traced_ = 0;
};

}  // namespace tomales
