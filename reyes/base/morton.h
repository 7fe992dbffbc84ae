// Places on the Morton curve (Z-order), along which points that are near in space are near in a list.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// Spreads the lowest 21 bits of x, so that each is followed by two zeros.
inline uint64_t spreadBits(uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

/// Returns the place of a cell, which has 21 bits for each axis.
inline uint64_t mortonPlace(const glm::uvec3& cell) {
  return spreadBits(cell.x) | spreadBits(cell.y) << 1 | spreadBits(cell.z) << 2;
}

/// Returns the place of a point in a box that is cut into 1024 along each axis; a coordinate that is no number counts
/// as 0.
inline uint32_t mortonPlace(const vec3& p, const Bound3& box) {
  const auto axis = [&](int k) {
    const float size = box.hi[k] - box.lo[k], at = size > 0 ? (p[k] - box.lo[k]) / size : 0;
    return static_cast<uint32_t>(at >= 0 ? std::min(at * 1024, 1023.0f) : 0.0f);
  };
  return static_cast<uint32_t>(mortonPlace(glm::uvec3(axis(0), axis(1), axis(2))));
}

/// Returns the indices of the points in the order of the curve, with 21 bits for the longest axis. Points at one place
/// keep their order.
std::vector<uint32_t> mortonOrder(std::span<const vec3> points);

}  // namespace tomales
