// Noun: the density of a Volume over its object space. It is a lattice of numbers, linear between its points, of which
// only bricks that hold something are kept. It gives the same bits for any machine and thread. Threads: built by one
// thread; const members may be called concurrently.
#pragma once
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// The density along a ray, piece by piece: within each piece it is constant.
struct DensityAlongRay {
  struct Knot {
    float distance, columnDensity;
  };
  std::vector<Knot> knots;  ///< Both numbers start at 0, and neither decreases.

  bool empty() const { return knots.empty() || !(knots.back().columnDensity > 0); }
  float columnDensity() const { return knots.empty() ? 0 : knots.back().columnDensity; }
  struct Place {
    float distance, columnDensity, density;
  };
  Place atDistance(float distance) const;
  Place atColumnDensity(float columnDensity) const;
};

class DensityGrid {
 public:
  static constexpr int kSide = 8;  ///< Points of a brick along each axis.
  static constexpr size_t kBrickFloats = size_t{kSide} * kSide * kSide;

  /// Makes an empty lattice with room for the points from `first` to `last`, whose coordinates are integers.
  /// `indexFromObject` finds them, and nothing is dense outside of `bound`, a box of object space.
  DensityGrid(const ivec3& first, const ivec3& last, const mat4& indexFromObject, const Bound3& bound);

  /// Returns how many bytes the table of bricks takes for such a lattice.
  static double tableBytes(const ivec3& first, const ivec3& last);
  /// Returns the values of the brick that holds a point, z fastest. It is made if there is none.
  float* brickAt(const ivec3& point);
  void set(const ivec3& point, float value);
  /// Call this when all bricks are filled. Negative values, infinities and NaN become 0; returns how many.
  size_t finish();

  const Bound3& bound() const { return bound_; }
  float at(const ivec3& point) const;

  /// Sets `out` to the density along a ray of object space: origin + t direction, from t0 to t1. Distances are (t - t0)
  /// times `unit`, and the column density is the integral of the density over that distance.
  void cross(const vec3& origin, const vec3& direction, float t0, float t1, float unit, DensityAlongRay& out) const;
  /// Returns the column density alone, as cross() finds it.
  float columnDensity(const vec3& origin, const vec3& direction, float t0, float t1) const;

  size_t bytes() const { return values_.capacity() * sizeof(float) + brickOf_.capacity() * sizeof(int32_t); }

 private:
  template <class Visit>
  void walk(const vec3& origin, const vec3& direction, float t0, float t1, const Visit& visit) const;
  ptrdiff_t entry(const ivec3& brick) const;
  float integral(const ivec3& cell, const vec3& origin, const vec3& direction, float t0, float t1) const;

  ivec3 first_, bricks_;  ///< first_: the first brick, in bricks.
  mat4 indexFromObject_;
  Bound3 bound_;
  std::vector<int32_t> brickOf_;  ///< Indexed by brick, z fastest: its number among those in `values_`; -1: none.
  /// Indexed by brick: 1 if some corner of the cells that begin in the brick is dense.
  std::vector<uint8_t> occupied_;
  std::vector<float> values_;
};

/// Cuts the part from t0 to t1 of a line to a box. Returns false if nothing is left.
bool cutLine(const Bound3& box, const vec3& origin, const vec3& direction, float& t0, float& t1);

}  // namespace tomales
