// Light that has entered a translucent body at the points of a cloud, and what of it leaves elsewhere: the hierarchy of
// Jensen, Buhler 2002, where points that are far away count as one. Private to gi. Threads: built by one; lookups are
// concurrent. Sums are made in the order of the tree, which is that of the cloud.
#pragma once
#include "gi/dipole.h"
#include "gi/point_cloud.h"

namespace tomales {

class Diffusion {
 public:
  /// Of the channels "_area" and "_radiance_t" (E/pi). Throws FileError.
  explicit Diffusion(const PointCloud& entries);

  /// E/pi that leaves at P. `millimetres` of one unit of the cloud; groups of points that are seen under less than
  /// `maxSolidAngle` steradians from outside of their bound count as one point.
  vec3 at(const vec3& P, const Dipole& dipole, float millimetres, float maxSolidAngle) const;

 private:
  struct Entry {
    vec3 P, flux;  ///< flux: area times E/pi.
    float area;
  };
  struct Group {
    Entry all;
    Bound3 bound;
    float seen;                   ///< Area.
    uint32_t begin, end, second;  ///< The first child follows; 0: a leaf.
  };
  uint32_t build(uint32_t begin, uint32_t end);

  std::vector<Entry> entries_;
  std::vector<Group> groups_;
};

}  // namespace tomales
