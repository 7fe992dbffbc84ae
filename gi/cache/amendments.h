// Private to gi: what this renderer adds to the published interpolation of irradiance records. What each one mends and
// costs is measured by tests/bench/amendments.py, which switches them off one at a time by the environment variable
// TOMALES_WITHOUT (names of the table, with commas between). docs/measured/irradiance_cache.md has the figures.
#pragma once
#include <cstdint>

#include "gi/cache/irradiance_record.h"

namespace tomales {

enum class Amendment {
  /// gi/cache/extrapolation.h: what records are off by together is known to the second order from their gradients.
  SecondOrder,
  /// gi/cache/disputes.h: records that disagree end before each other, and points at which they do get records.
  Disputes,
  /// Records serve 1.25 times as far when points are shaded, where light is even.
  Reach,
  /// A record fades out where a point lies behind it (Ward et al. 1988 end it there), within less than a pixel.
  Behind,
  /// gi/gather/gather.cpp: a record under an occluder is valid as far as that is high; points under unknown ones get
  /// records.
  Occluders,
  /// gi/cache/extrapolation.h: derivatives may at most double or extinguish E over a record's radius.
  Slopes,
};
inline constexpr const char* kAmendments[] = {"second-order", "disputes", "reach", "behind", "occluders", "slopes"};

/// False where the bench has switched it off.
bool isOn(Amendment amendment);

/// Factor on a record's radius: `wider` where light does not change over the radius, and 1 where it changes by kSteep
/// of itself, because a shadow's edge may lie beyond.
inline float reachFactor(const IrradianceRecord& r, float radius, float wider) {
  constexpr float kSteep = 0.3f;  // more lets the dark side of edges get light
  const vec3 change = radius * (r.translationGradient[0] + r.translationGradient[1] + r.translationGradient[2]);
  const float most = kSteep * (r.E.x + r.E.y + r.E.z);
  const float even = dot(change, change) < most * most ? 1 - dot(change, change) / (most * most) : 0.0f;
  return 1 + (wider - 1) * even;
}

/// A point behind the record sees other things than the record did (Ward et al. 1988, section 4), unless it is no
/// farther than bumps that rays do not see. Returns 0 behind, 1 in front, and less between. `pixel`: at kappa 1.
inline float frontFactor(const IrradianceRecord& r, const vec3& step, const vec3& n, float radius, float pixel) {
  constexpr float kOfRadius = 0.1f;
  constexpr float kOfPixel = 0.45f;  // thin surfaces have two sides, however far their records are valid
  const float tolerance = std::max(std::min(kOfRadius * radius, kOfPixel * pixel), r.unseenDisplacement);
  return 1 - std::clamp(-0.5f * dot(step, n + r.normal) / tolerance, 0.0f, 1.0f);
}

}  // namespace tomales
