// Private to NuPatch: trim curves as polygons in the parameter square of a surface, 0..1. Threads: const members may be
// called concurrently.
#pragma once
#include "reyes/prim_factories.h"

namespace tomales {

class TrimRegion {
 public:
  /// `begin`, `end`: the curves' parameters that become 0 and 1. Throws PrimError if a curve is no rational B-spline.
  TrimRegion(const TrimLoops& trim, const vec2& begin, const vec2& end, Problems& problems);

  bool keeps(const vec2& at) const;
  Kept kept(const vec2& lo, const vec2& hi) const;

 private:
  struct Segment {
    vec2 a, b;
  };
  struct Slabs {
    size_t first, last;
  };
  using Points = std::vector<glm::dvec2>;

  void addLoop(const std::vector<TrimCurve>& loop, size_t number, const vec2& begin, const vec2& end,
               Problems& problems);
  void sortIntoSlabs();
  Slabs slabsOf(float v0, float v1) const;
  bool touches(const Segment& s, const vec2& lo, const vec2& hi) const;

  bool keepsInside_;
  std::vector<Segment> segments_;
  std::vector<std::vector<uint32_t>> slabs_;  ///< Segments by their range of v; slabs divide 0..1 evenly.
};

}  // namespace tomales
