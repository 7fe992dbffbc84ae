// Openings through which a sky lights a room: rectangles towards which most of its samples go. They decide where samples fall, never what
// light arrives: directions past every portal are drawn too, so an opening that none is named for is dim with noise, not dark.
// Space: current. Threads: const members may be called concurrently.
#pragma once
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

class Portals {
 public:
  /// The square of -0.5 .. 0.5 in x and y of a space. False, and not added: it has no area.
  bool add(const mat4& currentFromSpace);
  bool empty() const { return portals_.empty(); }

  /// Of the samples of a point P with normal N that are to go to portals; 0: it lies behind all of them. N of 0: in the air.
  float share(const vec3& P, const vec3& N) const;
  /// The unit direction to a place on one of them. Pre: share(P, N) > 0.
  vec3 sample(const vec3& P, const vec3& N, vec2 xi) const;
  /// Of sample(), over solid angle; 0: past every portal.
  float density(const vec3& P, const vec3& N, const vec3& L) const;

 private:
  struct Portal {
    vec3 corner, u, v;  ///< u, v: edges.
    vec3 normal;        ///< As long as the area.
    float weight(const vec3& P, const vec3& N) const;
    /// Over solid angle, of places that are even on the portal.
    float density(const vec3& P, const vec3& L) const;
  };
  float weights(const vec3& P, const vec3& N) const;

  std::vector<Portal> portals_;
};

}  // namespace tomales
