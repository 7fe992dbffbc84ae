// Directions for tests.
#pragma once
#include "reyes/base/rng.h"

namespace tomales::test {

/// Unit; those of successive numbers cover the sphere evenly.
inline vec3 anyDirection(uint32_t i) {
  const vec2 xi = sobol2(i, 7);
  const float z = 1 - 2 * xi.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * xi.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace tomales::test
