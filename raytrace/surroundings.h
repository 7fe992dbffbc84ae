// Noun and pure functions: the coarse polygons around one place from which many rays leave. What those meet near their
// origin is asked of these few, and the traversal of the whole scene starts beyond them and calls no filter. Space:
// current, at shutter open. Threads: const members may be called concurrently.
#pragma once
#include <array>

#include "raytrace/hit_list.h"

namespace tomales {

class Surroundings {
 public:
  static constexpr size_t kMost =
      32;  ///< Polygons; where there are more, asking each costs a ray more than a filter does.

  /// Forgets all; polygons within `reach` of the origin are to be added.
  void reset(const vec3& origin, float reach);
  /// Something is near that cannot be added.
  void giveUp() { known_ = false; }
  /// Corners in the order of Quad (raytrace/tessellate.h). Those out of reach are dropped.
  void add(uint32_t group, uint32_t quad, bool flips, const std::array<vec3, 4>& corners) {
    add(group, quad, flips, corners, -1, corners);
  }
  /// The same of an instance, with the corners that its master has.
  void add(uint32_t group, uint32_t quad, bool flips, const std::array<vec3, 4>& corners, int instance,
           const std::array<vec3, 4>& ofMaster);

  bool gaveUp() const { return !known_; }
  /// Is all known that a ray from here meets at |t| <= window?
  bool know(const vec3& origin, float window) const { return known_ && window <= reach_ && origin == origin_; }

  /// Adds the hits at |t| <= window of a ray from the origin to `list`, unsorted.
  /// A ray that meets an edge meets both polygons there, so that it cannot slip between them.
  void meet(const vec3& direction, float window, HitList& list) const;

 private:
  /// A triangle is met by the rays from the origin that pass all its edges on the same side. The normal of the plane
  /// through an edge and the origin tells that side; the neighbour has the same one, with the other sign, to the bit.
  struct Near {
    uint32_t group, quad;
    int instance;
    bool flips;
    std::array<vec3, 2> normals;   ///< Of triangles 0-1-3 and 2-3-1, as hits tell them (PolygonHit::normal).
    std::array<float, 2> heights;  ///< Of the triangles in current space: dot(unnormalised normal, corner - origin)
    std::array<float, 8> x, y,
        z;  ///< Normals of the planes of edges 0-1, 1-3, 3-0, 1-2 and 2-3; the rest fills a vector.
  };

  std::vector<Near> polygons_;
  vec3 origin_{0};
  float reach_ = 0;
  bool known_ = false;  ///< False: nobody has looked, or something was given up.
};

}  // namespace tomales
