// Emitters of simple shape, sampled by solid angle: every direction in which a point sees one is as likely as any
// other.
//   rectangle  Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles"
//   sphere     the cone that it fills
//   disk       the elliptical cone that it fills: azimuth from a table of its angular width, height evenly
// Each shines from one side alone. Space: any; threads: pure.
#pragma once
#include "reyes/base/math.h"

namespace tomales {

struct EmitterShape {
  enum class Kind : uint8_t { Rectangle, Disk, Sphere };
  Kind kind = Kind::Rectangle;
  vec3 center{0};
  vec3 u{1, 0, 0},
      v{0, 1, 0};        ///< Perpendicular. Rectangle: halves of its edges; disk: radii; sphere: u alone is a radius.
  vec3 normal{0, 0, 1};  ///< Unit, of the shining side; spheres shine outwards.
  int group = -1;        ///< Of Scene::groups, that it is of; -1: not known.

  float area() const;
};

/// A point of an emitter, as another sees it. density 0: nothing shines from there, and nothing else is set.
struct SeenPoint {
  vec3 P{0}, N{0};    ///< N: unit, of the shining side
  float density = 0;  ///< With which samples fall there, over solid angle.
};

SeenPoint sampleSolidAngle(const EmitterShape& shape, const vec3& from, const vec2& xi);
/// The point that a ray along the unit `direction` meets, with the density that it would have had as a sample.
SeenPoint meet(const EmitterShape& shape, const vec3& from, const vec3& direction);

/// Of a sample whose density over area is known; 0: its back is seen.
double solidAngleDensity(const vec3& from, const vec3& P, const vec3& N, double areaDensity);

/// Evenly over all directions.
vec3 directionOnSphere(const vec2& xi);

/// Evenly by area; density is over area.
SeenPoint sampleArea(const EmitterShape& shape, const vec2& xi);

}  // namespace tomales
