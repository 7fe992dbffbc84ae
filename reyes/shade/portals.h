// Openings through which a sky lights a room: rectangles towards which most of its samples go. They decide where
// samples fall, never what light arrives: directions past every portal are drawn too, so an opening that none is named
// for is dim with noise, not dark. Space: current. Threads: const members may be called concurrently.
#pragma once
#include <vector>

#include "reyes/shade.h"

namespace tomales {

class Portals {
 public:
  /// The square of -0.5 .. 0.5 in x and y of a space. False, and not added: it has no area.
  bool add(const mat4& currentFromSpace);
  const std::vector<Portal>& all() const { return portals_; }

  /// Of the samples of a point P with normal N that are to go to portals; 0: it lies behind all of them. N of 0: in the
  /// air.
  float share(const vec3& P, const vec3& N) const;
  /// The unit direction to a place on one of them. Pre: share(P, N) > 0.
  vec3 sample(const vec3& P, const vec3& N, vec2 xi) const;
  /// Of sample(), over solid angle; 0: past every portal.
  float density(const vec3& P, const vec3& N, const vec3& L) const;

 private:
  float weights(const vec3& P, const vec3& N) const;

  std::vector<Portal> portals_;
};

}  // namespace tomales
