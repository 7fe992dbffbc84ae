// Private to gi: where the photons of a pass have arrived, found by place. Threads: visits are concurrent.
#pragma once
#include <span>
#include <vector>

#include "gi/photons.h"

namespace tomales {

/// Returns the numbers of points in their order along Morton's curve, on which neighbours are near each other.
std::vector<uint32_t> mortonOrder(std::span<const vec3> points);

class PhotonArrivals {
 public:
  explicit PhotonArrivals(const std::vector<StoredPhoton>& photons);

  /// Calls f(photon) for all photons in a box, and for some near it, in any order.
  template <class F>
  void visit(const Bound3& box, const F& f) const {
    if (!photons_.empty()) visit(boxes_.size() - 1, 0, box, f);
  }

 private:
  static constexpr size_t kFan = 8;

  template <class F>
  void visit(size_t level, size_t at, const Bound3& box, const F& f) const {
    const size_t first = at * kFan, below = level == 0 ? photons_.size() : boxes_[level - 1].size();
    for (size_t i = first; i < std::min(first + kFan, below); ++i)
      if (level == 0)
        f(photons_[i]);
      else if (overlap(boxes_[level - 1][i], box))
        visit(level - 1, i, box, f);
  }
  static bool overlap(const Bound3& a, const Bound3& b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
           b.lo.z <= a.hi.z;
  }

  std::vector<StoredPhoton> photons_;  ///< Along Morton's curve.
  /// Levels of boxes: a box of the lowest level holds kFan photons that follow each other, a box of the next as many
  /// boxes, and so on up to one.
  std::vector<std::vector<Bound3>> boxes_;
};

}  // namespace tomales
