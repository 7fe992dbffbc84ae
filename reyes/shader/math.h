// Vectors, colours and the scalar functions that every shader needs. Part of reyes/shader.h.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

/// Stands before functions with static variables, so that the renderer and each plugin have their own. Otherwise all
/// loaded plugins would share the variables of the first one, even one of another release.
#define TM_OF_THIS_PLUGIN __attribute__((visibility("hidden")))

/// Stands before a function of plain loops without branches. The function is built for SSE2, AVX2 and AVX-512, and
/// chosen by CPU; all give the same bits. A build for one of them defines this macro as nothing.
#if defined(RSL_HOT)
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define RSL_HOT __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define RSL_HOT
#endif
#ifdef __GNUC__
#define RSL_INLINE \
  inline __attribute__((always_inline))  ///< Inlined, since the clones of RSL_HOT vectorise only their own code.
#define RSL_INLINED __attribute__((always_inline))  ///< The same for a lambda; it stands after the parameters.
#else
#define RSL_INLINE inline
#define RSL_INLINED
#endif

namespace rsl {

struct Vec3 {
  float x = 0, y = 0, z = 0;
};
using Color = Vec3;

RSL_INLINE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
RSL_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
RSL_INLINE Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
RSL_INLINE Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
RSL_INLINE Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
RSL_INLINE Vec3 operator*(float s, Vec3 a) { return a * s; }
RSL_INLINE Vec3 operator/(Vec3 a, float s) { return a * (1 / s); }
RSL_INLINE float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
RSL_INLINE Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
RSL_INLINE float length(Vec3 a) { return std::sqrt(dot(a, a)); }
/// Returns a zero vector for a zero vector, as RSL does.
RSL_INLINE Vec3 normalize(Vec3 a) {
  const float l = length(a);
  return l > 0 ? a / l : Vec3{};
}
/// Sets two unit vectors that are perpendicular to the unit vector n and to each other (Duff et al. 2017, "Building an
/// Orthonormal Basis, Revisited").
RSL_INLINE void orthonormalBasis(Vec3 n, Vec3& tangent, Vec3& bitangent) {
  const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  bitangent = {b, sign + n.y * n.y * a, -n.y};
}
/// RISpec faceforward with Nref = Ng: returns N on the side of the surface from which I arrives.
RSL_INLINE Vec3 faceforward(Vec3 N, Vec3 I, Vec3 Ng) { return dot(I, Ng) > 0 ? -N : N; }
RSL_INLINE Vec3 reflect(Vec3 I, Vec3 N) { return I - 2 * dot(I, N) * N; }
/// Returns the refracted direction, or zero for total reflection (RISpec 15.2). I and N have unit length, and N points
/// against I. eta is the index of refraction on I's side of the surface over the index on the other side.
RSL_INLINE Vec3 refract(Vec3 I, Vec3 N, float eta) {
  const float c = -dot(I, N), k = 1 - eta * eta * (1 - c * c);
  return k < 0 ? Vec3{} : eta * I + (eta * c - std::sqrt(k)) * N;
}
/// Returns the share of unpolarised light that is reflected where refract() would refract.
RSL_INLINE float fresnel(Vec3 I, Vec3 N, float eta) {
  const float c = std::min(1.0f, std::abs(dot(I, N))), k = 1 - eta * eta * (1 - c * c);
  if (k <= 0) return 1;
  const float t = std::sqrt(k), s = (eta * c - t) / (eta * c + t), p = (c - eta * t) / (c + eta * t);
  return 0.5f * (s * s + p * p);
}

/// Returns `lo` for x below it even where `lo` is more than `hi`: shaders that march in steps of clamp(step, least,
/// rest) rely on that to come to an end.
RSL_INLINE float clamp(float x, float lo, float hi) { return x < lo ? lo : x > hi ? hi : x; }
RSL_INLINE float mix(float a, float b, float t) { return a + (b - a) * t; }
RSL_INLINE Vec3 mix(Vec3 a, Vec3 b, float t) { return a + (b - a) * t; }
RSL_INLINE float smoothstep(float lo, float hi, float x) {
  if (hi <= lo) return x < lo ? 0.0f : 1.0f;
  const float t = clamp((x - lo) / (hi - lo), 0, 1);
  return t * t * (3 - 2 * t);
}

/// Returns a if the condition holds, and b otherwise, without a branch. GCC may turn a conditional expression into a
/// branch, for instance around a call or a conversion to int and back.
RSL_INLINE float chosen(bool condition, float a, float b) {
  const uint32_t mask = condition ? 0xffffffffU : 0;
  return __builtin_bit_cast(float,
                            (__builtin_bit_cast(uint32_t, a) & mask) | (__builtin_bit_cast(uint32_t, b) & ~mask));
}
// These round towards zero and down, as std::trunc and std::floor do, but in arithmetic that every processor can apply
// to many numbers at once: SSE2 has no instruction for either.
RSL_INLINE float wholePart(float x) {
  const bool broken = std::abs(x) < 0x1p23f;  // beyond, all numbers are whole
  const float part = static_cast<float>(static_cast<int32_t>(chosen(broken, x, 0)));
  const uint32_t sign = __builtin_bit_cast(uint32_t, x) & 0x80000000U;  // keeps the sign of -0
  return chosen(broken, __builtin_bit_cast(float, __builtin_bit_cast(uint32_t, part) | sign), x);
}
RSL_INLINE float wholeBelow(float x) {
  const float part = wholePart(x);
  return part - (part > x ? 1.0f : 0.0f);
}

}  // namespace rsl
