// Noun: the places where gather rays have found light much brighter than its surroundings, as rectangles and spheres.
// Later records aim some of their rays at them. It needs reyes/base alone. Radiance and E/pi are luminances here.
// Space: that of the caller. Threads: const members may be called concurrently.
#pragma once
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

struct BrightHit {
  vec3 position;
  float radiance;
  vec3 normal;  ///< Unit normal of the surface that was hit, on the side that the ray saw.
};

/// The bright light that one record has found.
struct BrightFind {
  float irradiance = 0;
  std::vector<BrightHit> hits;
};

class BrightSpots {
 public:
  struct Spot {
    vec3 center;
    float radius, radiance;
    vec3 normal;              ///< Unit normal of a rectangle, which shines to that side; zero means a sphere.
    vec2 found{1};            ///< Share of the extents that held hits. A margin surrounds it.
    vec3 halfU{0}, halfV{0};  ///< Perpendicular vectors from the rectangle's centre to the middles of two edges.
  };
  BrightSpots() = default;
  /// Takes over spots that another object has learnt.
  BrightSpots(std::vector<Spot> spots, float irradiance)
      : spots_(std::move(spots)), irradiance_(irradiance), records_(1) {}
  /// Computes the spots anew. The same finds in the same order give the same spots.
  void learn(const std::vector<BrightFind>& finds);
  const std::vector<Spot>& spots() const { return spots_; }
  /// Returns the mean E/pi of all finds.
  float irradiance() const {
    return records_ > 0 ? static_cast<float>(irradiance_ / static_cast<double>(records_)) : 0.0f;
  }

 private:
  std::vector<BrightHit> hits_;
  std::vector<Spot> spots_;
  double irradiance_ = 0;
  size_t records_ = 0;
};

/// Chooses directions from one point to the spots, the more often the more light would come from there.
class SpotAim {
 public:
  /// Weighs the spots as if nothing were between them and the point.
  SpotAim(const BrightSpots& spots, const vec3& position, const vec3& normal);

  size_t targets() const { return targets_.size(); }
  /// Returns a unit direction to the part of one target in which hits were. xi: uniform in [0,1).
  vec3 probe(size_t target, const vec2& xi) const;
  /// Scales the light of each target by the share that is expected to arrive, in [0,1].
  void dim(const std::vector<float>& shares);
  float radiance(size_t target) const { return targets_[target].share / targets_[target].covered; }

  /// Returns E/pi of all spots; 0 if there is none to aim at.
  float irradiance() const { return irradiance_; }
  /// Returns an upper bound of the share of the cosine-weighted hemisphere that the spots cover: they may overlap.
  float coverage() const { return coverage_; }
  /// Returns a unit direction to a spot. choice, xi: uniform in [0,1).
  vec3 direction(float choice, const vec2& xi) const;
  /// Returns the probability density of direction() over solid angle.
  float pdf(const vec3& direction) const;

 private:
  /// A cone of directions, or a rectangle whose points are chosen evenly. A rectangle seen from the side covers much
  /// less than the cone around it.
  struct Target {
    vec3 path, axis;    ///< path leads to the centre; axis is its unit vector.
    vec3 normal, u, v;  ///< The members of Spot; a zero normal means a cone.
    vec2 found;
    float versine;         ///< 1 - cos of the cone's half angle.
    float share, covered;  ///< Parts of irradiance() and of coverage().
    float upTo = 0;        ///< The shares of the targets up to this one, summed; a choice below it takes one of them.
    /// Probability density of choosing the target and the place: over solid angle for a cone, over area for a
    /// rectangle.
    float pdf = 0;

    vec3 toward(const vec2& xi) const;
    float pdfOfPlace() const;
  };
  void settle();

  std::vector<Target> targets_;
  float irradiance_ = 0, coverage_ = 0;
};

}  // namespace tomales
