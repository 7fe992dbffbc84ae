// The maths vocabulary: GLM under our names, bounds, and the few helpers that every unit needs.
// Matrices act on column vectors and are named destination-from-source (cameraFromObject * p). RenderMan writes
// matrices for row vectors. Sixteen RIB floats, read in order into a column-major mat4, are that same transformation
// for column vectors, and RIB's pre-concatenation is `ctm * m`.
#pragma once
#define GLM_FORCE_XYZW_ONLY
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace tomales {

using glm::cross;
using glm::dot;
using glm::ivec2;
using glm::ivec3;
using glm::mat3;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr float kCosine45 = 0.70710678f;  ///< Sine and cosine of 45 degrees.
constexpr float kPi = 3.14159265358979323846f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kRiInfinity = 1e30f;  ///< Scenes and files write this, or more (RI_INFINITY is 1e38), for no limit.

inline vec3 transformPoint(const mat4& m, const vec3& p) {
  const vec4 h = m * vec4(p, 1.0f);
  return h.w == 1.0f ? vec3(h) : vec3(h) / h.w;
}
inline vec3 transformVector(const mat4& m, const vec3& v) { return mat3(m) * v; }
/// Returns the mean factor by which a transformation scales lengths: the cube root of that of volumes.
inline float lengthScale(const mat4& m) { return std::cbrt(std::abs(glm::determinant(mat3(m)))); }

/// Returns the unit vector, or `fallback` where v has no direction (zero, NaN or infinite).
inline vec3 normalizeOr(const vec3& v, const vec3& fallback) {
  const float length2 = dot(v, v);
  return length2 > 0.0f && length2 < kInfinity ? v / std::sqrt(length2) : fallback;
}
inline bool isFinite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
inline float luminance(const vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }
inline float maxComponent(const vec3& c) { return std::max(c.x, std::max(c.y, c.z)); }
/// Returns the axis along which a box of this size is longest.
inline int longestAxis(const vec3& size) { return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2; }
inline float lerp(float a, float b, float t) { return a + (b - a) * t; }

/// Writes two unit vectors that complete unit vector n to a right-handed frame (Duff et al. 2017).
inline void orthonormalBasis(const vec3& n, vec3& tangent, vec3& bitangent) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  tangent = vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
  bitangent = vec3(b, sign + n.y * n.y * a, -n.y);
}

/// Axis-aligned box; empty until extended.
struct Bound3 {
  vec3 lo{kInfinity}, hi{-kInfinity};

  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  void extend(const vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  void extend(const Bound3& b) {
    lo = glm::min(lo, b.lo);
    hi = glm::max(hi, b.hi);
  }
  vec3 center() const { return 0.5f * (lo + hi); }
  vec3 size() const { return hi - lo; }
  Bound3 grown(float margin) const { return {lo - vec3(margin), hi + vec3(margin)}; }
  vec3 corner(int i) const { return {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z}; }
};

/// Returns the box around the eight transformed corners.
inline Bound3 transformBound(const mat4& m, const Bound3& b) {
  Bound3 out;
  for (int i = 0; i < 8; ++i) out.extend(transformPoint(m, b.corner(i)));
  return out;
}

struct Bound2 {
  vec2 lo{kInfinity}, hi{-kInfinity};
  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y); }
  void extend(const vec2& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
};

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return std::max(0, x1 - x0); }
  int height() const { return std::max(0, y1 - y0); }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  /// Tells whether some pixel is in both. Pre: neither is empty.
  bool overlaps(const PixelRect& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

}  // namespace tomales
