// Private to gi: a balanced kd-tree over photons. Threads: one thread builds it; searches are concurrent.
#pragma once
#include "gi/point_cloud.h"

namespace tomales {

struct NearPhoton {
  float distance2;  ///< What PhotonTree::distance2() returns.
  uint32_t photon;  ///< Index in the order of the tree.
  bool operator<(const NearPhoton& o) const {
    return distance2 != o.distance2 ? distance2 < o.distance2 : photon < o.photon;
  }
};

class PhotonTree {
 public:
  static constexpr size_t kLookupsPerTask = 256;  ///< Searches that one thread makes at a time.

  explicit PhotonTree(PointCloud photons);

  /// Returns the photons in the order of the tree, in which neighbours are neighbours in space.
  const PointCloud& photons() const { return photons_; }
  const vec3& position(uint32_t i) const { return photons_.position[i]; }
  const vec3& normal(uint32_t i) const { return photons_.normal[i]; }

  int surface(uint32_t i) const { return surface_[i]; }  ///< 0: not known.

  /// Returns the squared distance by which photons are compared. Distance along the normal counts four times, and much
  /// more to a photon of another surface, so that a search covers a disk and not a ball. It is infinite for photons
  /// that do not face as N does. N and surface: as in nearest().
  float distance2(uint32_t photon, const vec3& P, const vec3& N, int surface) const;
  /// Finds the `most` nearest photons within `radius` that face as `N` does (zero: all, in a ball), as a heap with the
  /// farthest in front. Photons of another surface than `surface` (0: all are of this one) count only if they continue
  /// it.
  void nearest(const vec3& P, const vec3& N, int surface, size_t most, float radius,
               std::vector<NearPhoton>& heap) const;

 private:
  struct Split {
    float at;
    int axis;
  };
  void build(std::vector<uint32_t>& order, uint32_t begin, uint32_t end, uint32_t node);

  PointCloud photons_;
  std::vector<uint8_t> surface_;
  std::vector<Split> splits_;  ///< Node n has children 2n + 1 and 2n + 2; each node halves its range.
};

}  // namespace tomales
