// Private to gi: where the photons of a pass have arrived, found by place. Threads: visits are concurrent.
#pragma once
#include "gi/photons.h"
#include "gi/photons/run_boxes.h"

namespace tomales {

class PhotonArrivals {
 public:
  explicit PhotonArrivals(const std::vector<StoredPhoton>& photons);

  /// Calls f(photon) for all photons in a box, and for some near it.
  template <class F>
  void visit(const Bound3& box, const F& f) const {
    boxes_.visit(
        [&](const Bound3& b) {
          return b.lo.x <= box.hi.x && box.lo.x <= b.hi.x && b.lo.y <= box.hi.y && box.lo.y <= b.hi.y &&
                 b.lo.z <= box.hi.z && box.lo.z <= b.hi.z;
        },
        [&](size_t i) { f(photons_[i]); });
  }

 private:
  std::vector<StoredPhoton> photons_;  ///< Along Morton's curve.
  RunBoxes boxes_;
};

}  // namespace tomales
