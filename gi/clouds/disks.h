// Private to gi: the disks of a point cloud, which cover a hemisphere and send light into it (P. Christensen 2008,
// "Point-Based Approximate Color Bleeding"). They form a tree, whose groups count as one disk where they are seen under
// a small angle. The paper rasterises disks on a hemisphere; here lines of sight meet them, so that nearer disks always
// hide those behind. Threads: one thread builds it; lookups are concurrent. The answer depends on the cloud alone, not
// on threads.
#pragma once
#include "gi/point_cloud.h"
#include "reyes/cloud_services.h"

namespace tomales {

/// Averages over a hemisphere, weighted by the cosine. radiance: in units of the channel.
struct HemisphereView {
  float covered = 0;
  vec3 radiance{0.0f};
  float coarse = 0;  ///< Where disks are nearer than they are large, and much larger than the micropolygon that looks.
};

class Disks {
 public:
  /// channel: 3 floats, the light that the front of each disk sends; without such a channel disks send none. Areas are
  /// those of the channel "_area", else of the squares whose diagonals are the disks' diameters, as bake3d() makes
  /// them.
  Disks(const PointCloud& cloud, const std::string& channel);
  bool sends() const { return sends_; }

  /// Averages what is seen from P, the middle of a micropolygon of this radius. N: unit.
  HemisphereView seenFrom(const vec3& P, const vec3& N, const DisksQuery& query, float radius = 0) const;

 private:
  struct Disk {
    vec3 P, N;  ///< A zero N means a sphere.
    float radius, area;
    vec3 light;
  };
  /// Sums over the disks of a group, weighted by area, which give its appearance in any direction.
  struct Sum {
    vec3 P{0.0f};  ///< Mean position.
    float area = 0;
    /// Sum of N N^T: sqrt(area d.facing.d) is the area covered along d, exactly where all disks face alike.
    mat3 facing{0.0f};
    vec3 front{0.0f};       ///< Sum of N.
    vec3 light{0.0f};       ///< Sum of the light.
    mat3 lightFront{0.0f};  ///< Sum of the light times N, a column for each axis.
    void add(const Sum& other);
  };
  struct Group {
    Sum sum;
    Bound3 bound;
    float seen;                   ///< Area as seen from afar.
    uint32_t begin, end, second;  ///< The first child follows its parent; second is 0 in a leaf.
  };
  class LineOfSight;
  static Sum sumOf(const Disk& disk);
  uint32_t build(uint32_t begin, uint32_t end);

  std::vector<Disk> disks_;
  std::vector<Group> groups_;
  bool sends_ = false;
  std::vector<vec3> directions_;  ///< Cosine-weighted directions around +z.
};

}  // namespace tomales
