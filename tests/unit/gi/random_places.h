// Random places for tests, the same in each run.
#pragma once
#include "reyes/base/math.h"
#include "reyes/base/rng.h"

namespace tomales {

/// Returns place number i of a series in the cube from -1 to 1. Each salt has a series of its own.
inline vec3 randomIn(uint32_t i, uint32_t salt) {
  const auto number = [&](uint32_t axis) { return 2 * unitFloat(hashCombine(i, salt, axis)) - 1; };
  return {number(0), number(1), number(2)};
}

}  // namespace tomales
