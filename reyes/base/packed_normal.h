// Unit normals in 32 bits, for files.
#pragma once
#include <cfloat>

#include "reyes/base/math.h"

namespace tomales {

/// Folds the octahedron onto a square of 65535 x 65535 (Meyer et al. 2010), with an error below 0.004 degrees. A vector
/// that is zero or not finite becomes 0, which is no normal.
inline uint32_t packNormal(const vec3& n) {
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  if (!(sum > 0 && sum <= FLT_MAX)) return 0;
  const vec3 a = n / sum;
  vec2 o(a.x, a.y);
  if (a.z < 0) o = (vec2(1) - glm::abs(vec2(a.y, a.x))) * vec2(a.x < 0 ? -1.0f : 1.0f, a.y < 0 ? -1.0f : 1.0f);
  const auto pack = [](float v) { return static_cast<uint32_t>(std::lround(v * 32767.0f) + 32768); };
  return pack(o.x) << 16 | pack(o.y);
}

inline vec3 unpackNormal(uint32_t packed) {
  if (packed == 0) return vec3(0.0f);
  const auto part = [](uint32_t v) { return (static_cast<float>(v & 0xffff) - 32768.0f) / 32767.0f; };
  vec3 n(part(packed >> 16), part(packed), 0);
  n.z = 1 - std::abs(n.x) - std::abs(n.y);
  const float fold = std::max(-n.z, 0.0f);
  n.x += n.x >= 0 ? -fold : fold;
  n.y += n.y >= 0 ? -fold : fold;
  return normalizeOr(n, vec3(0, 0, 1));
}

}  // namespace tomales
