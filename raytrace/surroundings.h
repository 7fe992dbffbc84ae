// Noun and pure functions: the coarse polygons around one place from which many rays leave. Rays test these few
// polygons near their origin, and the traversal of the whole scene starts beyond them and calls no filter. Space:
// current, at shutter open. Threads: const members may be called concurrently.
#pragma once
#include <array>

#include "raytrace/hit_list.h"

namespace tomales {

class Surroundings {
 public:
  /// Greatest number of polygons; testing more would cost a ray more than a filter does.
  static constexpr size_t kMost = 32;

  /// Removes all polygons; those within `reach` of the origin are to be added.
  void reset(const vec3& origin, float reach);
  /// Notes that something is near that cannot be added.
  void giveUp() { known_ = false; }
  /// Adds a polygon with corners in the order of Quad (raytrace/tessellate.h). One that is out of reach is dropped.
  void add(uint32_t group, uint32_t quad, bool flips, const std::array<vec3, 4>& corners) {
    add(group, quad, flips, corners, -1, corners);
  }
  /// The same for a polygon of an instance; `ofMaster`: its corners in the master's space.
  void add(uint32_t group, uint32_t quad, bool flips, const std::array<vec3, 4>& corners, int instance,
           const std::array<vec3, 4>& ofMaster);

  bool gaveUp() const { return !known_; }
  /// Tells whether all polygons are known that a ray from here meets at |t| <= window.
  bool know(const vec3& origin, float window) const { return known_ && window <= reach_ && origin == origin_; }

  /// Adds the hits at |t| <= window of a ray from the origin to `list`, unsorted. A ray that meets an edge meets both
  /// polygons there, so that it cannot slip between them.
  void meet(const vec3& direction, float window, HitList& list) const;

 private:
  /// A ray from the origin meets a triangle if it passes all edges on the same side. The sign of its product with the
  /// normal of the plane through an edge and the origin tells the side; the neighbour has the same normal, negated, to
  /// the bit.
  struct Near {
    uint32_t group, quad;
    int instance;
    bool flips;
    std::array<vec3, 2> normals;   ///< Normals of triangles 0-1-3 and 2-3-1, as in PolygonHit::normal.
    std::array<float, 2> heights;  ///< dot(unnormalised normal, corner - origin) of the triangles, in current space.
    /// Normals of the planes of edges 0-1, 1-3, 3-0, 1-2 and 2-3. The other elements fill a vector register.
    std::array<float, 8> x, y, z;
  };

  std::vector<Near> polygons_;
  vec3 origin_{0};
  float reach_ = 0;
  bool known_ = false;  ///< False before a reset, and after giveUp().
};

}  // namespace tomales
