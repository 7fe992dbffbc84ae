// RSL's noise, pnoise and cellnoise of one to four dimensions, and spline with all its bases and their inverses (RISpec
// 15.1). Results have the same bits on every machine, because they use only integer hashes and IEEE arithmetic.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>

#include "reyes/shader/math.h"

namespace rsl {

/// Hashes a lattice point to 32 bits, by the mix "lowbias32" (C. Wellons) once for each axis.
RSL_INLINE uint32_t latticeHash(int32_t x, int32_t y, int32_t z) {
  const auto mixIn = [](uint32_t h, int32_t c) {
    h = (h ^ static_cast<uint32_t>(c)) * 0x9e3779b9U;
    h ^= h >> 16;
    h *= 0x7feb352dU;
    h ^= h >> 15;
    h *= 0x846ca68bU;
    h ^= h >> 16;
    return h;
  };
  return mixIn(mixIn(mixIn(0, x), y), z);
}

/// Returns x, or -x where the lowest bit of `bits` is set, without a branch.
RSL_INLINE float withSign(float x, uint32_t bits) {
  return __builtin_bit_cast(float, __builtin_bit_cast(uint32_t, x) ^ (bits << 31));
}
/// Returns the dot product of p with one of the twelve gradients to the edges of a cube (Perlin 2002, "Improving
/// noise").
RSL_INLINE float gradient(uint32_t hash, Vec3 p) {
  const uint32_t h = hash & 15;
  const float a = h < 8 ? p.x : p.y, b = h < 4 ? p.y : (h & 13) == 12 ? p.x : p.z;
  return withSign(a, h) + withSign(b, h >> 1);
}

RSL_INLINE float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
/// Converts a whole number to an integer. Large numbers wrap instead of overflowing: the result is fmod(c, 2^20),
/// exactly, without a call. NaN and infinities become 0.
RSL_INLINE int32_t latticeCoordinate(float c) {
  const float rest = c - wholePart(c * 0x1p-20f) * 0x1p20f;
  return static_cast<int32_t>(chosen(std::abs(rest) < 0x1p20f, rest, 0));
}

/// A cell of the lattice, and a position in it.
struct LatticePlace {
  int32_t x, y, z;
  Vec3 f;
};
RSL_INLINE LatticePlace latticePlace(Vec3 p) {
  const Vec3 cell{wholeBelow(p.x), wholeBelow(p.y), wholeBelow(p.z)};
  return {latticeCoordinate(cell.x), latticeCoordinate(cell.y), latticeCoordinate(cell.z), p - cell};
}
constexpr float kNearLattice = 0x1p19f;  ///< The distance from the origin up to which nearLatticePlace() works.
RSL_INLINE bool isNearLattice(Vec3 p) {
  return (std::abs(p.x) < kNearLattice) & (std::abs(p.y) < kNearLattice) & (std::abs(p.z) < kNearLattice);
}
/// Does the same as latticePlace(), except for the sign of zeros, with a quarter of the work. Pre: isNearLattice(p).
RSL_INLINE LatticePlace nearLatticePlace(Vec3 p) {
  const int32_t x = static_cast<int32_t>(p.x), y = static_cast<int32_t>(p.y), z = static_cast<int32_t>(p.z);
  const int32_t dx = static_cast<float>(x) > p.x, dy = static_cast<float>(y) > p.y, dz = static_cast<float>(z) > p.z;
  const int32_t cx = x - dx, cy = y - dy, cz = z - dz;
  return {cx, cy, cz, p - Vec3{static_cast<float>(cx), static_cast<float>(cy), static_cast<float>(cz)}};
}

RSL_INLINE float signedNoiseAt(const LatticePlace& p) {
  const auto corner = [&](int i, int j, int k) RSL_INLINED {
    const Vec3 offset{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
    return gradient(latticeHash(p.x + i, p.y + j, p.z + k), p.f - offset);
  };
  const float u = fade(p.f.x), v = fade(p.f.y), w = fade(p.f.z);
  const auto face = [&](int k) RSL_INLINED {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u), v);
  };
  return clamp(mix(face(0), face(1), w), -1, 1);
}
/// Returns gradient noise in [-1, 1], which is zero on the integer lattice and twice differentiable.
RSL_INLINE float signedNoise(Vec3 p) { return signedNoiseAt(latticePlace(p)); }

namespace noise_detail {

/// latticeHash() with a fourth coordinate.
RSL_INLINE uint32_t hash4(int32_t x, int32_t y, int32_t z, int32_t w) {
  uint32_t h = (latticeHash(x, y, z) ^ static_cast<uint32_t>(w)) * 0x9e3779b9U;
  h ^= h >> 16;
  h *= 0x7feb352dU;
  h ^= h >> 15;
  h *= 0x846ca68bU;
  h ^= h >> 16;
  return h;
}

/// A coordinate as a cell and a position in it. With a period other than 0 the lattice repeats.
struct Axis {
  int32_t lo, hi;
  float f;
  RSL_INLINE Axis(float x, float period) {
    const float cell = wholeBelow(x), p = wholeBelow(period);
    const auto wrapped = [&](float c)
                             RSL_INLINED { return latticeCoordinate(chosen(p >= 1, c - p * wholeBelow(c / p), c)); };
    f = x - cell;
    lo = wrapped(cell);
    hi = wrapped(cell + 1);
  }
  RSL_INLINE int32_t at(int end) const { return end ? hi : lo; }
  RSL_INLINE float from(int end) const { return f - static_cast<float>(end); }
};

/// Returns the dot product with one of 32 gradients, towards the edges of a hypercube (Perlin): a sum of three
/// coordinates with signs.
RSL_INLINE float gradient4(uint32_t hash, float x, float y, float z, float w) {
  const uint32_t skipped = hash >> 3 & 3;
  const auto add = [&](float sum, uint32_t k, float p) RSL_INLINED {
    const uint32_t sign = (skipped < k ? hash >> (k - 1) : hash >> k) & 1;
    const float more = sum + (sign ? -p : p);
    return skipped == k ? sum : more;
  };
  return add(add(add(add(0, 0, x), 1, y), 2, z), 3, w);
}

}  // namespace noise_detail

/// Returns gradient noise of four dimensions in [-1, 1], which repeats along axes with a period. It is zero on the
/// integer lattice and twice differentiable.
RSL_INLINE float signedNoise4(Vec3 p, float t, Vec3 period = {}, float tPeriod = 0) {
  using noise_detail::Axis;
  const Axis x(p.x, period.x), y(p.y, period.y), z(p.z, period.z), w(t, tPeriod);
  const auto corner = [&](int i, int j, int k, int l) RSL_INLINED {
    return noise_detail::gradient4(noise_detail::hash4(x.at(i), y.at(j), z.at(k), w.at(l)), x.from(i), y.from(j),
                                   z.from(k), w.from(l));
  };
  const float u[4] = {fade(x.f), fade(y.f), fade(z.f), fade(w.f)};
  const auto edge = [&](int i, int j, int k) RSL_INLINED { return mix(corner(i, j, k, 0), corner(i, j, k, 1), u[3]); };
  const auto face = [&](int i, int j) RSL_INLINED { return mix(edge(i, j, 0), edge(i, j, 1), u[2]); };
  const auto cube = [&](int i) RSL_INLINED { return mix(face(i, 0), face(i, 1), u[1]); };
  return clamp(mix(cube(0), cube(1), u[0]), -1, 1);
}
/// Returns signedNoise(p) with the given period along each axis.
RSL_INLINE float signedPeriodicNoise(Vec3 p, Vec3 period) {
  using noise_detail::Axis;
  const Axis x(p.x, period.x), y(p.y, period.y), z(p.z, period.z);
  const auto corner = [&](int i, int j, int k) RSL_INLINED {
    return gradient(latticeHash(x.at(i), y.at(j), z.at(k)), {x.from(i), y.from(j), z.from(k)});
  };
  const float u = fade(x.f), v = fade(y.f), w = fade(z.f);
  const auto face = [&](int k) RSL_INLINED {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u), v);
  };
  return clamp(mix(face(0), face(1), w), -1, 1);
}

// Noise of one or two dimensions is a cut through noise of three, between the planes of the lattice: on the planes most
// gradients would vanish.
constexpr float kNoiseCut = 0.5f;

/// Implements RSL's noise(): gradient noise, scaled to [0, 1].
RSL_INLINE float noiseAt(const LatticePlace& p) { return 0.5f + 0.5f * signedNoiseAt(p); }
RSL_INLINE float noise(Vec3 p) { return noiseAt(latticePlace(p)); }
RSL_INLINE float noise(float x) { return noise(Vec3{x, kNoiseCut, kNoiseCut}); }
RSL_INLINE float noise(float x, float y) { return noise(Vec3{x, y, kNoiseCut}); }
RSL_INLINE float noise(Vec3 p, float t) { return 0.5f + 0.5f * signedNoise4(p, t); }
RSL_INLINE float pnoise(Vec3 p, Vec3 period) { return 0.5f + 0.5f * signedPeriodicNoise(p, period); }
RSL_INLINE float pnoise(float x, float period) { return pnoise(Vec3{x, kNoiseCut, kNoiseCut}, {period, 0, 0}); }
RSL_INLINE float pnoise(float x, float y, float xPeriod, float yPeriod) {
  return pnoise(Vec3{x, y, kNoiseCut}, {xPeriod, yPeriod, 0});
}
RSL_INLINE float pnoise(Vec3 p, float t, Vec3 period, float tPeriod) {
  return 0.5f + 0.5f * signedNoise4(p, t, period, tPeriod);
}
/// Returns noise in [0, 1) that is constant in each unit cell.
RSL_INLINE float cellnoiseAt(const LatticePlace& p, int32_t t) {
  return static_cast<float>(static_cast<int32_t>(noise_detail::hash4(p.x, p.y, p.z, t) >> 8)) * 0x1p-24f;
}
RSL_INLINE float cellnoise(Vec3 p, float t = 0) {
  return cellnoiseAt(latticePlace(p), latticeCoordinate(wholeBelow(t)));
}
RSL_INLINE float cellnoise(float x, float y = 0) { return cellnoise(Vec3{x, y, 0}); }

/// The three independent values of a triple are looked up far from each other in the lattice.
constexpr Vec3 kTriplePlaces[3] = {{0, 0, 0}, {1031, 523, 259}, {2053, 4099, 131}};
template <class Of>
Vec3 triple(Vec3 p, const Of& of) {
  return {of(p + kTriplePlaces[0]), of(p + kTriplePlaces[1]), of(p + kTriplePlaces[2])};
}
inline Vec3 noise3(Vec3 p) {
  return triple(p, [](Vec3 q) { return noise(q); });
}
inline Vec3 noise3(Vec3 p, float t) {
  return triple(p, [&](Vec3 q) { return noise(q, t); });
}
inline Vec3 noise3(float x) { return noise3(Vec3{x, kNoiseCut, kNoiseCut}); }
inline Vec3 noise3(float x, float y) { return noise3(Vec3{x, y, kNoiseCut}); }
inline Vec3 pnoise3(Vec3 p, Vec3 period) {
  return triple(p, [&](Vec3 q) { return pnoise(q, period); });
}
inline Vec3 cellnoise3(Vec3 p, float t = 0) {
  return triple(p, [&](Vec3 q) { return cellnoise(q, t); });
}

// --- Splines

enum class Basis { CatmullRom, Bezier, BSpline, Hermite, Linear };
/// Returns the basis of that name in RSL, or nothing. RIB calls bspline "b-spline", and catrom "catmull-rom".
inline std::optional<Basis> basisNamed(const std::string& name) {
  if (name == "catrom" || name == "catmull-rom") return Basis::CatmullRom;
  if (name == "bezier") return Basis::Bezier;
  if (name == "bspline" || name == "b-spline") return Basis::BSpline;
  if (name == "hermite") return Basis::Hermite;
  if (name == "linear") return Basis::Linear;
  return std::nullopt;
}
/// Returns the weights of four knots at t in [0, 1].
inline void splineWeights(Basis basis, float t, float* w) {
  const float t2 = t * t, t3 = t2 * t, s = 1 - t;
  switch (basis) {
    case Basis::Bezier:
      w[0] = s * s * s;
      w[1] = 3 * t * s * s;
      w[2] = 3 * t2 * s;
      w[3] = t3;
      break;
    case Basis::BSpline:
      w[0] = s * s * s / 6;
      w[1] = (3 * t3 - 6 * t2 + 4) / 6;
      w[2] = (-3 * t3 + 3 * t2 + 3 * t + 1) / 6;
      w[3] = t3 / 6;
      break;
    case Basis::Hermite:
      w[0] = 2 * t3 - 3 * t2 + 1;
      w[1] = t3 - 2 * t2 + t;
      w[2] = -2 * t3 + 3 * t2;
      w[3] = t3 - t2;
      break;
    case Basis::Linear:
      w[0] = 0;
      w[1] = s;
      w[2] = t;
      w[3] = 0;
      break;
    default:
      w[0] = 0.5f * (-t3 + 2 * t2 - t);
      w[1] = 0.5f * (3 * t3 - 5 * t2 + 2);
      w[2] = 0.5f * (-3 * t3 + 4 * t2 + t);
      w[3] = 0.5f * (t3 - t2);
  }
}
/// Returns the value of a curve of n >= 4 knots at x, which is clamped to [0, 1]; NaN counts as 0. Hermite knots
/// alternate between points and tangents.
template <class T>
T spline(Basis basis, float x, const T* knots, int n) {
  const int stride = basis == Basis::Bezier    ? 3
                     : basis == Basis::Hermite ? 2
                                               : 1,
            segments = std::max(1, (n - 4) / stride + 1);
  const float along = (x > 0 ? clamp(x, 0, 1) : 0.0f) * static_cast<float>(segments);
  const int segment = std::min(static_cast<int>(along), segments - 1);
  float w[4];
  splineWeights(basis, along - static_cast<float>(segment), w);
  const T* k = knots + segment * stride;
  return w[0] * k[0] + w[1] * k[1] + w[2] * k[2] + w[3] * k[3];
}
template <class T>
T spline(float x, std::initializer_list<T> knots) {
  return spline(Basis::CatmullRom, x, knots.begin(), static_cast<int>(knots.size()));
}
/// Implements RSL's "solve" bases: returns where a monotonic curve takes a value; 0 or 1 for a value beyond its ends.
inline float solveSpline(Basis basis, float value, const float* knots, int n) {
  const float sign = spline(basis, 1, knots, n) >= spline(basis, 0, knots, n) ? 1.0f : -1.0f;
  float lo = 0, hi = 1;
  for (int k = 0; k < 32; ++k) {
    const float middle = 0.5f * (lo + hi);
    (sign * (spline(basis, middle, knots, n) - value) < 0 ? lo : hi) = middle;
  }
  return 0.5f * (lo + hi);
}

}  // namespace rsl
