// RSL's noise, pnoise and cellnoise of one to four dimensions, and spline with all its bases and their inverses
// (rispec-table 9.1). The same bits on every machine: integer hashes and IEEE arithmetic alone.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>

#include "reyes/shader_math.h"

namespace rsl {

/// A 32-bit mix of a lattice point ("lowbias32", C. Wellons, once an axis).
RSL_INLINE uint32_t latticeHash(int32_t x, int32_t y, int32_t z) {
  const auto mixIn = [](uint32_t h, int32_t c) {
    h = (h ^ static_cast<uint32_t>(c)) * 0x9e3779b9U;
    h ^= h >> 16, h *= 0x7feb352dU, h ^= h >> 15, h *= 0x846ca68bU, h ^= h >> 16;
    return h;
  };
  return mixIn(mixIn(mixIn(0, x), y), z);
}

/// One of the twelve gradients to the edges of a cube (Perlin 2002, "Improving noise"), by p.
RSL_INLINE float gradient(uint32_t hash, Vec3 p) {
  const uint32_t h = hash & 15;
  const float a = h < 8 ? p.x : p.y, b = h < 4 ? p.y : (h & 13) == 12 ? p.x : p.z;
  return (h & 1 ? -a : a) + (h & 2 ? -b : b);
}

/// Gradient noise in [-1, 1]: zero on the integer lattice, twice differentiable, the same on every machine.
RSL_INLINE float signedNoise(Vec3 p) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)}, f = p - cell;
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  // Lattice coordinates wrap far out instead of overflowing the integer: fmod(c, 2^20), exactly, without a call.
  const auto lattice = [](float c) { return static_cast<int32_t>(c - std::trunc(c * 0x1p-20f) * 0x1p20f); };
  const int32_t x = lattice(cell.x), y = lattice(cell.y), z = lattice(cell.z);
  const auto corner = [&](int i, int j, int k) {
    const Vec3 offset{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
    return gradient(latticeHash(x + i, y + j, z + k), f - offset);
  };
  const float u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const auto face = [&](int k) {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u), v);
  };
  return clamp(mix(face(0), face(1), w), -1, 1);
}
/// RSL's noise(): the same in [0, 1].
inline float noise(Vec3 p) { return 0.5f + 0.5f * signedNoise(p); }

namespace noise_detail {

/// As latticeHash, with a fourth coordinate.
RSL_INLINE uint32_t hash4(int32_t x, int32_t y, int32_t z, int32_t w) {
  uint32_t h = (latticeHash(x, y, z) ^ static_cast<uint32_t>(w)) * 0x9e3779b9U;
  h ^= h >> 16, h *= 0x7feb352dU, h ^= h >> 15, h *= 0x846ca68bU, h ^= h >> 16;
  return h;
}
RSL_INLINE float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// A coordinate as a cell and the place in it; a period (0: none) joins the ends of the lattice.
struct Axis {
  int32_t lo, hi;
  float f;
  RSL_INLINE Axis(float x, float period) {
    const float cell = std::floor(x);
    f = x - cell;
    const auto wrapped = [&](float c) {
      const float p = std::floor(period);
      if (p >= 1) c -= p * std::floor(c / p);
      return static_cast<int32_t>(c - std::trunc(c * 0x1p-20f) * 0x1p20f);
    };
    lo = wrapped(cell), hi = wrapped(cell + 1);
  }
};

/// One of 32 gradients, to the edges of a hypercube (Perlin), by p.
RSL_INLINE float gradient4(uint32_t hash, const float* p) {
  const uint32_t h = hash & 31;
  const uint32_t skipped = h >> 3;
  float sum = 0;
  for (uint32_t k = 0, bit = 0; k < 4; ++k) {
    if (k == skipped) continue;
    sum += h >> bit & 1 ? -p[k] : p[k];
    ++bit;
  }
  return sum;
}

}  // namespace noise_detail

/// Gradient noise in [-1, 1] of four dimensions; of fewer where the rest is left out. Zero on the integer lattice,
/// twice differentiable.
inline float signedNoise4(Vec3 p, float w, Vec3 period = {}, float wPeriod = 0) {
  using namespace noise_detail;
  const Axis axes[4] = {{p.x, period.x}, {p.y, period.y}, {p.z, period.z}, {w, wPeriod}};
  float value[16];
  for (int corner = 0; corner < 16; ++corner) {
    int32_t at[4];
    float offset[4];
    for (int k = 0; k < 4; ++k) {
      const bool high = corner >> k & 1;
      at[k] = high ? axes[k].hi : axes[k].lo, offset[k] = axes[k].f - (high ? 1.0f : 0.0f);
    }
    value[corner] = gradient4(hash4(at[0], at[1], at[2], at[3]), offset);
  }
  for (int k = 3, n = 8; k >= 0; --k, n /= 2)
    for (int i = 0; i < n; ++i) value[i] = mix(value[i], value[i + n], fade(axes[k].f));
  return clamp(value[0], -1, 1);
}
/// signedNoise(p) with joined ends.
inline float signedPeriodicNoise(Vec3 p, Vec3 period) {
  using namespace noise_detail;
  const Axis x(p.x, period.x), y(p.y, period.y), z(p.z, period.z);
  const auto corner = [&](int i, int j, int k) {
    const Vec3 offset{x.f - static_cast<float>(i), y.f - static_cast<float>(j), z.f - static_cast<float>(k)};
    return gradient(latticeHash(i ? x.hi : x.lo, j ? y.hi : y.lo, k ? z.hi : z.lo), offset);
  };
  const float u = fade(x.f), v = fade(y.f), w = fade(z.f);
  const auto face = [&](int k) {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u), v);
  };
  return clamp(mix(face(0), face(1), w), -1, 1);
}

// One and two dimensions are cuts through three, between the lattice planes: on them the gradients would vanish more
// often than not.
constexpr float kNoiseCut = 0.5f;

inline float noise(float x) { return noise(Vec3{x, kNoiseCut, kNoiseCut}); }
inline float noise(float x, float y) { return noise(Vec3{x, y, kNoiseCut}); }
inline float noise(Vec3 p, float t) { return 0.5f + 0.5f * signedNoise4(p, t); }
inline float pnoise(Vec3 p, Vec3 period) { return 0.5f + 0.5f * signedPeriodicNoise(p, period); }
inline float pnoise(float x, float period) { return pnoise(Vec3{x, kNoiseCut, kNoiseCut}, {period, 0, 0}); }
inline float pnoise(float x, float y, float xPeriod, float yPeriod) {
  return pnoise(Vec3{x, y, kNoiseCut}, {xPeriod, yPeriod, 0});
}
inline float pnoise(Vec3 p, float t, Vec3 period, float tPeriod) {
  return 0.5f + 0.5f * signedNoise4(p, t, period, tPeriod);
}
/// Constant in each unit cell, [0, 1).
inline float cellnoise(Vec3 p, float t = 0) {
  using noise_detail::Axis;
  return static_cast<float>(noise_detail::hash4(Axis(p.x, 0).lo, Axis(p.y, 0).lo, Axis(p.z, 0).lo, Axis(t, 0).lo) >>
                            8) *
         0x1p-24f;
}
inline float cellnoise(float x, float y = 0) { return cellnoise(Vec3{x, y, 0}); }

/// Three values that have nothing to do with each other: `of` is asked at three places of the lattice far from each
/// other.
template <class Of>
Vec3 triple(Vec3 p, const Of& of) {
  return {of(p), of(p + Vec3{1031, 523, 259}), of(p + Vec3{2053, 4099, 131})};
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
/// Of RSL's name; catmull-rom for others.
inline Basis basisOf(const std::string& name) {
  return name == "bezier"     ? Basis::Bezier
         : name == "b-spline" ? Basis::BSpline
         : name == "hermite"  ? Basis::Hermite
         : name == "linear"   ? Basis::Linear
                              : Basis::CatmullRom;
}
/// Weights of four knots at t in [0, 1].
inline void splineWeights(Basis basis, float t, float* w) {
  const float t2 = t * t, t3 = t2 * t, s = 1 - t;
  switch (basis) {
    case Basis::Bezier:
      w[0] = s * s * s, w[1] = 3 * t * s * s, w[2] = 3 * t2 * s, w[3] = t3;
      break;
    case Basis::BSpline:
      w[0] = s * s * s / 6, w[1] = (3 * t3 - 6 * t2 + 4) / 6, w[2] = (-3 * t3 + 3 * t2 + 3 * t + 1) / 6, w[3] = t3 / 6;
      break;
    case Basis::Hermite:
      w[0] = 2 * t3 - 3 * t2 + 1, w[1] = t3 - 2 * t2 + t, w[2] = -2 * t3 + 3 * t2, w[3] = t3 - t2;
      break;
    case Basis::Linear:
      w[0] = 0, w[1] = s, w[2] = t, w[3] = 0;
      break;
    default:
      w[0] = 0.5f * (-t3 + 2 * t2 - t), w[1] = 0.5f * (3 * t3 - 5 * t2 + 2), w[2] = 0.5f * (-3 * t3 + 4 * t2 + t),
      w[3] = 0.5f * (t3 - t2);
  }
}
/// At x in [0, 1] (clamped) of a curve through n >= 4 knots; Hermite knots are points and tangents by turns.
template <class T>
T spline(Basis basis, float x, const T* knots, int n) {
  const int stride = basis == Basis::Bezier    ? 3
                     : basis == Basis::Hermite ? 2
                                               : 1,
            segments = std::max(1, (n - 4) / stride + 1);
  const float along = clamp(x, 0, 1) * static_cast<float>(segments);
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
/// RSL's "solve" bases: where a curve that rises or falls throughout has a value; 0 or 1 beyond its ends.
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
