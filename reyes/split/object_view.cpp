#include "reyes/split/object_view.h"

#include "reyes/split/placement.h"

namespace tomales {
namespace {

constexpr float kDeepest = 2;  ///< A coarse piece's far end is at most this many times as far away as its near end.

}  // namespace

bool ObjectView::cannotBeSeen(const Bound3& bare) const {
  const Bound3 bound = bare.grown(object_.displacementBound);
  if (!isFinite(bound.lo) || !isFinite(bound.hi)) return true;
  // Solids are clipped where their surface is known, not before.
  return object_.solid < 0 ? camera_.outside(bound, window_) : camera_.outsideWindow(bound, window_);
}

bool ObjectView::isOfOneScale(const Bound3& bare) const {
  return !camera_.perspective() || bare.hi.z <= kDeepest * bare.lo.z;
}

Bound2 ObjectView::rasterOf(Bound3 bound, float reach_px) const {
  if (camera_.perspective()) bound.lo.z = std::max(bound.lo.z, camera_.nearClip());
  return tomales::rasterOf(bound, reach_px, camera_);
}

float ObjectView::coarsening(uint32_t patch, const UvRect& rect, const Bound3& bound) const {
  const Attributes& a = *object_.attributes;
  const float focus = a.focusFactor * leastBlur_px(camera_, std::max(bound.lo.z, camera_.nearClip()), bound.hi.z) / 4;
  const bool moves = a.motionFactor > 0 && object_.keyTimes.size() > 1;
  const float motion = moves ? a.motionFactor * pathLength_px(object_, camera_, patch, rect) / 4 : 0;
  const float scale = std::max({1.0f, focus, std::sqrt(motion)});
  return std::isfinite(scale) ? scale : 1.0f;
}

}  // namespace tomales
