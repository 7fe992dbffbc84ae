// Noun: where gather rays have found light much brighter than what is around, as disks and spheres at which later records aim some of
// their rays. Over reyes/base alone. Radiance and E/pi are luminances here.
// Space: that of the caller. Threads: const members may be called concurrently.
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
    vec3 normal;  ///< Of a disk that shines to that side; 0: a sphere.
  };
  /// The same spots for the same finds in the same order.
  void learn(const std::vector<BrightFind>& finds);
  const std::vector<Spot>& spots() const { return spots_; }
  /// Mean of all finds.
  float irradiance() const { return records_ > 0 ? static_cast<float>(irradiance_ / static_cast<double>(records_)) : 0.0f; }

 private:
  std::vector<BrightHit> hits_;
  std::vector<Spot> spots_;
  double irradiance_ = 0;
  size_t records_ = 0;
};

/// Directions from one point to the spots, more towards those from which more light would come if nothing were in between.
class SpotAim {
 public:
  SpotAim(const BrightSpots& spots, const vec3& position, const vec3& normal);
  /// E/pi if nothing hid the spots; 0: there is none to aim at.
  float irradiance() const { return irradiance_; }
  /// Of the cosine-weighted hemisphere, at most: the spots may overlap.
  float coverage() const { return coverage_; }
  /// xi: uniform in [0,1); unit.
  vec3 direction(float choice, const vec2& xi) const;
  /// Of direction() over solid angle.
  float density(const vec3& direction) const;

 private:
  /// A cone of directions, or a disk, whose points are chosen evenly: seen from the side it is much less than the cone around it.
  struct Target {
    vec3 path, axis, normal;       ///< To its centre; axis: along it, unit; normal: 0: a cone.
    float radius2, versine, upTo;  ///< versine: one less the cosine of a cone's half angle; upTo: of the choice
    float density;                 ///< Over solid angle in a cone, over the area of a disk.
  };
  std::vector<Target> targets_;
  float irradiance_ = 0, coverage_ = 0;
};

}  // namespace tomales
