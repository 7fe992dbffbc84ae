// Noun: where gather rays have found light much brighter than what is around, as rectangles and spheres at which later
// records aim some of their rays. Over reyes/base alone. Radiance and E/pi are luminances here. Space: that of the
// caller. Threads: const members may be called concurrently.
#pragma once
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

struct BrightHit {
  vec3 position;
  float radiance;
  vec3 normal;  ///< Of what was hit, on the side that was seen.
};

/// What one record has found.
struct BrightFind {
  float irradiance = 0;
  std::vector<BrightHit> hits;
};

class BrightSpots {
 public:
  struct Spot {
    vec3 center;
    float radius, radiance;
    vec3 normal;              ///< Of a rectangle that shines to that side; 0: a sphere.
    vec2 found{1};            ///< Share of its extents in which hits were: around them is a margin.
    vec3 halfU{0}, halfV{0};  ///< From the rectangle's centre to the middles of two edges, perpendicular.
  };
  /// The same spots for the same finds in the same order.
  void learn(const std::vector<BrightFind>& finds);
  const std::vector<Spot>& spots() const { return spots_; }
  /// Mean of all finds.
  float irradiance() const {
    return records_ > 0 ? static_cast<float>(irradiance_ / static_cast<double>(records_)) : 0.0f;
  }

 private:
  std::vector<BrightHit> hits_;
  std::vector<Spot> spots_;
  double irradiance_ = 0;
  size_t records_ = 0;
};

/// Directions from one point to the spots, more towards those from which more light would come.
class SpotAim {
 public:
  /// As if nothing were in between.
  SpotAim(const BrightSpots& spots, const vec3& position, const vec3& normal);

  size_t targets() const { return targets_.size(); }
  /// A direction to where something of one of them was found. xi: uniform in [0,1); unit.
  vec3 probe(size_t target, const vec2& xi) const;
  /// Of each target the share of its light that is expected to arrive, in [0,1].
  void dim(const std::vector<float>& shares);
  float radiance(size_t target) const { return targets_[target].share / targets_[target].covered; }

  /// E/pi of the spots; 0: there is none to aim at.
  float irradiance() const { return irradiance_; }
  /// Of the cosine-weighted hemisphere, at most: the spots may overlap.
  float coverage() const { return coverage_; }
  /// xi: uniform in [0,1); unit.
  vec3 direction(float choice, const vec2& xi) const;
  /// Of direction() over solid angle.
  float density(const vec3& direction) const;

 private:
  /// A cone of directions, or a rectangle, whose points are chosen evenly: seen from the side it is much less than the
  /// cone around it.
  struct Target {
    vec3 path, axis;    ///< To its centre; axis: along it, unit.
    vec3 normal, u, v;  ///< As Spot's; normal 0: a cone.
    vec2 found;
    float versine;         ///< One less the cosine of a cone's half angle.
    float share, covered;  ///< Of irradiance() and coverage().
    float upTo = 0;        ///< Of the choice.
    float density = 0;     ///< Of the choice and of the place: of a cone over solid angle, of a rectangle over area.

    vec3 toward(const vec2& xi) const;
    float densityOfPlace() const;
  };
  void settle();

  std::vector<Target> targets_;
  float irradiance_ = 0, coverage_ = 0;
};

}  // namespace tomales
