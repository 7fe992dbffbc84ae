// The disks of a point cloud as what covers a hemisphere and sends light into it (P. Christensen 2008, "Point-Based
// Approximate Color Bleeding"): a tree, whose groups count as one disk where they are seen under a small angle. Where
// the paper rasterises disks on a hemisphere, lines of sight meet them here: what is nearer hides what is behind it
// wherever it is. Private to gi. Threads: built by one; lookups are concurrent. The answer depends on the cloud alone,
// not on threads.
#pragma once
#include "gi/point_cloud.h"
#include "reyes/shade.h"

namespace tomales {

/// Averages over a hemisphere, weighted by the cosine.
struct HemisphereView {
  float covered = 0;
  vec3 radiance{0.0f};
};

class Disks {
 public:
  /// channel: of 3 floats, what the front of each disk sends; where there is none, nothing. Areas are those of the
  /// channel "_area", else of the squares whose diagonals are the diameters, as bake3d() makes them.
  Disks(const PointCloud& cloud, const std::string& channel);
  bool sends() const { return sends_; }

  /// N: unit.
  HemisphereView seenFrom(const vec3& P, const vec3& N, const DisksQuery& query) const;

 private:
  struct Disk {
    vec3 P, N;  ///< N zero: a sphere.
    float radius, area;
    vec3 light;
  };
  /// Of a group or one disk, area by area: what it shows in any direction.
  struct Sum {
    vec3 P{0.0f};  ///< Mean
    float area = 0;
    mat3 facing{
        0.0f};  ///< Sum of N N^T: sqrt(area d.facing.d) is what it covers along d, exactly where all faces alike.
    vec3 front{0.0f};       ///< Sum of N
    vec3 light{0.0f};       ///< and of the light,
    mat3 lightFront{0.0f};  ///< and of the light by N, a column for each axis.
    void add(const Sum& other);
  };
  struct Group {
    Sum sum;
    Bound3 bound;
    float seen;                   ///< Area
    uint32_t begin, end, second;  ///< The first child follows; 0: a leaf.
  };
  class Sight;
  static Sum sumOf(const Disk& disk);
  uint32_t build(uint32_t begin, uint32_t end);

  std::vector<Disk> disks_;
  std::vector<Group> groups_;
  bool sends_ = false;
  std::vector<vec3> directions_;  ///< Around +z, by the cosine.
};

}  // namespace tomales
