// Noun: what fills the space on one side of a surface, as photons meet it: homogeneous, scattering evenly in all
// directions (Jensen and Christensen 1998, "Efficient Simulation of Light Transport in Scenes with Participating Media
// using Photon Maps").
#pragma once
#include "reyes/base/math.h"
#include "reyes/state.h"

namespace tomales {

/// Per unit of length, by colour.
struct Medium {
  vec3 scattering{0.0f}, extinction{0.0f};

  bool empty() const { return !(maxComponent(extinction) > 0); }
  /// Collisions per unit of length are sampled as of the densest colour that a photon of this power still has; those
  /// that the others have not are no event (Woodcock 1965).
  float majorant(const vec3& power) const {
    return maxComponent(glm::mix(vec3(0.0f), extinction, glm::greaterThan(power, vec3(0.0f))));
  }
};

/// Of the parameters "scattering" and "absorption" of a volume shader, colours per unit of the world, where one has
/// them. `worldUnit`: length of one of the world in the space of the result. Null: nothing.
Medium mediumOf(const ShaderCall* volume, float worldUnit);

/// What becomes of a photon of this power where it has collided. xi: even in [0, 1).
struct Collision {
  enum Event { Absorbed, Scattered, None } event;
  vec3 power;  ///< From there on: as even as it came.
};
Collision collide(const Medium& medium, const vec3& power, float xi);

}  // namespace tomales
