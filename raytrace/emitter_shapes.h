// Emitters of simple shape, sampled by solid angle: all directions in which a point sees one are equally likely.
//   rectangle  Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles"
//   sphere     uniformly over the cone that it fills
//   disk       the elliptical cone that it fills: azimuth from a table of its angular width, height uniformly
// Each shines from one side alone. Space: any; threads: pure.
#pragma once
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

struct EmitterShape {
  enum class Kind : uint8_t { Rectangle, Disk, Sphere };
  Kind kind = Kind::Rectangle;
  vec3 center{0};
  /// Perpendicular vectors. Rectangle: halves of its edges; disk: radii; sphere: u alone is a radius.
  vec3 u{1, 0, 0}, v{0, 1, 0};
  vec3 normal{0, 0, 1};  ///< Unit normal of the shining side; spheres shine outwards.
  int group = -1;        ///< Its index in Scene::groups; -1: not known.

  float area() const;
};

/// A point of an emitter, as seen from another point. pdf 0: nothing shines from there, and the other members are
/// not set.
struct SeenPoint {
  vec3 P{0}, N{0};  ///< N: unit normal of the shining side.
  float pdf = 0;    ///< Probability density of samples there, over solid angle.
};

SeenPoint sampleSolidAngle(const EmitterShape& shape, const vec3& from, const vec2& xi);
/// Returns the point that a ray along the unit `direction` meets, with the density of a sample there.
SeenPoint meet(const EmitterShape& shape, const vec3& from, const vec3& direction);

/// Adds the points in which the unit `direction` passes the shape, from any side. Their density is over area.
void crossings(const EmitterShape& shape, const vec3& from, const vec3& direction, std::vector<SeenPoint>& out);

/// Converts a density over area to one over solid angle. It becomes 0 where the back is seen.
double solidAnglePdf(const vec3& from, const vec3& P, const vec3& N, double areaPdf);

/// Returns a direction, uniform over the sphere.
vec3 directionOnSphere(const vec2& xi);

/// Returns a point, uniform over the area; the density is over area.
SeenPoint sampleArea(const EmitterShape& shape, const vec2& xi);

}  // namespace tomales
