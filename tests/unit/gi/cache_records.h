// Records of irradiance for tests, and random places, the same in each run.
#pragma once
#include "gi/irradiance_cache.h"
#include "reyes/base/rng.h"

namespace tomales {

inline constexpr vec3 kUp{0, 0, 1};
inline const Bound3 kBox{vec3(-1), vec3(1)};

inline IrradianceRecord recordAt(const vec3& position, const vec3& E, float closest = 1, float pixelSize = 0.01f) {
  IrradianceRecord r{};
  r.position = position;
  r.normal = kUp;
  r.light.E = E;
  for (vec3& d : r.dominant) d = kUp;
  r.harmonicMean = r.closest = closest;
  r.pixelSize = pixelSize;
  return r;
}

inline vec3 tilted(float degrees) { return {std::sin(degrees * kPi / 180), 0, std::cos(degrees * kPi / 180)}; }

inline float weightOfOne(const CacheSettings& settings, const IrradianceRecord& record, const vec3& x, const vec3& n,
                         float pixelSize) {
  IrradianceCache cache(kBox, settings);
  cache.insert(record);
  return cache.lookup(x, n, pixelSize).weight;
}

/// Returns place number i of a series in the cube from -1 to 1. Each salt has a series of its own.
inline vec3 randomIn(uint32_t i, uint32_t salt) {
  const auto number = [&](uint32_t axis) { return 2 * unitFloat(hashCombine(i, salt, axis)) - 1; };
  return {number(0), number(1), number(2)};
}

}  // namespace tomales
