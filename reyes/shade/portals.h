// Openings through which a sky lights a room: rectangles towards which most of its samples go. They decide where
// samples fall, never what light arrives: directions past every portal are drawn too, so an opening without a portal
// gives noise, not darkness. Space: current. Threads: const members may be called concurrently.
#pragma once
#include <vector>

#include "reyes/shade.h"

namespace tomales {

class Portals {
 public:
  /// Adds the square from -0.5 to 0.5 in x and y of a space. Returns false, and adds nothing, if it has no area.
  bool add(const mat4& currentFromSpace);
  const std::vector<Portal>& all() const { return portals_; }

  /// Returns the share of the samples of a point P with normal N that go to portals; 0 if P lies behind all of them. N
  /// is 0 in the air.
  float share(const vec3& P, const vec3& N) const;
  /// Returns a unit direction to a point on one of the portals. Pre: share(P, N) is greater than 0.
  vec3 sample(const vec3& P, const vec3& N, vec2 xi) const;
  /// Returns the density of sample() over solid angle; 0 for directions past every portal.
  float pdf(const vec3& P, const vec3& N, const vec3& L) const;

 private:
  float weights(const vec3& P, const vec3& N) const;

  std::vector<Portal> portals_;
};

}  // namespace tomales
