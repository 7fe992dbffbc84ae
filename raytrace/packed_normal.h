// Unit vectors in 32 bits: the octahedron folded onto a square of 65535 x 65535 (Meyer et al. 2010). Off by less than 0.004 degrees.
#pragma once
#include "reyes/base/math.h"

namespace tomales {

inline uint32_t packNormal(const vec3& n) {
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  vec2 p = sum > 0 ? vec2(n) / sum : vec2(0);
  if (n.z < 0) p = {(p.x < 0 ? -1.0f : 1.0f) * (1 - std::abs(p.y)), (p.y < 0 ? -1.0f : 1.0f) * (1 - std::abs(p.x))};
  const auto bits = [](float x) { return static_cast<uint32_t>(std::lround((0.5f * x + 0.5f) * 65534)); };
  return bits(p.x) | bits(p.y) << 16;
}

inline vec3 unpackNormal(uint32_t packed) {
  const auto axis = [](uint32_t bits) { return static_cast<float>(bits & 0xffffU) / 32767 - 1; };
  vec3 n(axis(packed), axis(packed >> 16), 0);
  n.z = 1 - std::abs(n.x) - std::abs(n.y);
  const float fold = std::max(-n.z, 0.0f);
  n.x += n.x < 0 ? fold : -fold, n.y += n.y < 0 ? fold : -fold;
  return glm::normalize(n);
}

}  // namespace tomales
