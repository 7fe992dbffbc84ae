// Private to gi: diffusion of light that enters a translucent body at the points of a cloud and leaves it elsewhere.
// Source: the hierarchy of Jensen and Buhler 2002, in which points that are far away count as one. Threads: one thread
// builds it; lookups are concurrent. Sums are made in the order of the tree, which is that of the cloud.
#pragma once
#include "gi/clouds/dipole.h"
#include "gi/point_cloud.h"

namespace tomales {

class Diffusion {
 public:
  /// Reads the channels "_area" and "_radiance_t" (E/pi). Throws FileError.
  explicit Diffusion(const PointCloud& entries);

  /// Returns E/pi that leaves at P. `millimetres`: length of one unit of the cloud. A group of points that is seen
  /// under less than `maxSolidAngle` steradians, from outside of its bound, counts as one point.
  vec3 at(const vec3& P, const Dipole& dipole, float millimetres, float maxSolidAngle) const;

 private:
  struct Entry {
    vec3 P, flux;  ///< flux is area times E/pi.
    float area;
  };
  struct Group {
    Entry all;
    Bound3 bound;
    float seen;                   ///< Area as seen from afar.
    uint32_t begin, end, second;  ///< The first child follows its parent; second is 0 in a leaf.
  };
  uint32_t build(uint32_t begin, uint32_t end);

  std::vector<Entry> entries_;
  std::vector<Group> groups_;
};

}  // namespace tomales
