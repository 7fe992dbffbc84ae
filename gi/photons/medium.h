// Noun: the medium on one side of a surface, for photons: homogeneous, scattering evenly in all directions (Jensen and
// Christensen 1998, "Efficient Simulation of Light Transport in Scenes with Participating Media using Photon Maps").
#pragma once
#include "reyes/shade.h"

namespace tomales {

/// Coefficients per unit of length, by colour.
struct Medium {
  vec3 scattering{0.0f}, extinction{0.0f};

  bool empty() const { return !(maxComponent(extinction) > 0); }
  /// Returns the collisions per unit of length. They are sampled for the densest colour that a photon of this power
  /// still has; at some of them the other colours do not collide, which is a null collision (Woodcock 1965).
  float majorant(const vec3& power) const {
    return maxComponent(glm::mix(vec3(0.0f), extinction, glm::greaterThan(power, vec3(0.0f))));
  }
};

/// `worldUnit`: length of one unit of the world in the space of the result.
Medium mediumOf(const MediumColors& colors, float worldUnit);

/// The event of a photon of this power at a collision. xi: uniform in [0, 1).
struct Collision {
  enum Event { Absorbed, Scattered, None } event;
  vec3 power;  ///< Power after the event; its expectation is the right one, and it stays about as large as it was.
};
Collision collide(const Medium& medium, const vec3& power, float xi);

}  // namespace tomales
