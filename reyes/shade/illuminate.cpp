#include "reyes/shade/illuminate.h"

#include <bit>
#include <cfloat>
#include <cmath>

#include "reyes/base/simd.h"

namespace tomales {
namespace {

#define TOMALES_INLINE inline __attribute__((always_inline))  // clones vectorise only what is part of them

/// x where it holds, else 0. It is no branch, as the compiler would move computations into one and not vectorise.
TOMALES_INLINE float where(bool holds, float x) {
  return std::bit_cast<float>(std::bit_cast<uint32_t>(x) & (0U - static_cast<uint32_t>(holds)));
}

/// 1 over the length, or 0 for a length of 0.
TOMALES_INLINE float inverseLength(float x, float y, float z) {
  const float square = x * x + y * y + z * z;
  const float inverse = 1.0f / std::sqrt(square);
  return where((square > 0.0f) & (square < kInfinity), inverse);
}

/// x^e for normal x up to 1 and e > 0. The logarithm is a series about 1, so its relative error is small there, which
/// large exponents need.
TOMALES_INLINE float power(float x, float e) {
  constexpr uint32_t kSqrtHalf = 0x3f3504f3U, kMantissa = 23;
  const uint32_t bits = std::bit_cast<uint32_t>(x) - kSqrtHalf;
  const int32_t exponent = static_cast<int32_t>(bits) >> kMantissa;
  const float m = std::bit_cast<float>((bits & 0x7fffffU) + kSqrtHalf);  // sqrt(1/2) .. sqrt(2)
  const float s = (m - 1.0f) / (m + 1.0f), s2 = s * s;
  const float series = 1.0f + s2 * (1.0f / 3 + s2 * (1.0f / 5 + s2 * (1.0f / 7 + s2 * (1.0f / 9))));
  constexpr float kTwoOverLn2 = 2.88539008f;
  const float y = e * (static_cast<float>(exponent) + kTwoOverLn2 * s * series);
  const float bounded = y > -126.0f ? y : -126.0f;
  const float whole = static_cast<float>(static_cast<int32_t>(bounded - 0.5f)), f = bounded - whole;  // -1/2 .. 1/2
  const float g = f * 0.693147181f;
  const float fraction =
      1.0f + g * (1.0f + g * (1.0f / 2 + g * (1.0f / 6 + g * (1.0f / 24 + g * (1.0f / 120 + g * (1.0f / 720))))));
  const float scale = std::bit_cast<float>(static_cast<uint32_t>(static_cast<int32_t>(whole) + 127) << kMantissa);
  return where(y > -126.0f, scale * fraction);
}

}  // namespace

TOMALES_HOT void normalizeAll(int n, TmConstVec3 from, TmVec3 to) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float x = from.x[i], y = from.y[i], z = from.z[i], inverse = inverseLength(x, y, z);
    to.x[i] = x * inverse;
    to.y[i] = y * inverse;
    to.z[i] = z * inverse;
  }
}

TOMALES_HOT bool allFinite(int n, TmConstVec3 v) {
  int bad = 0;
  for (int i = 0; i < n; ++i) {
    const float zero = v.x[i] * 0.0f + v.y[i] * 0.0f + v.z[i] * 0.0f;
    bad |= !(zero == 0.0f);
  }
  return bad == 0;
}

TOMALES_HOT void markFacing(int n, const uint8_t* active, TmConstVec3 N, TmConstVec3 L, uint8_t* facing) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float cosine = N.x[i] * L.x[i] + N.y[i] * L.y[i] + N.z[i] * L.z[i];
    facing[i] = static_cast<uint8_t>((cosine > 0.0f) & (active[i] != 0));
  }
}

TOMALES_HOT void addDiffuse(int n, const float* share, TmConstVec3 N, TmConstVec3 L, TmConstVec3 Cl, TmVec3 out) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float weight = share[i] * (L.x[i] * N.x[i] + L.y[i] * N.y[i] + L.z[i] * N.z[i]);
    const bool counts = share[i] != 0.0f;
    out.x[i] += where(counts, Cl.x[i] * weight);
    out.y[i] += where(counts, Cl.y[i] * weight);
    out.z[i] += where(counts, Cl.z[i] * weight);
  }
}

TOMALES_HOT void addHighlight(int n, const float* share, TmConstVec3 N, TmConstVec3 V, const float* exponent,
                              TmConstVec3 L, TmConstVec3 Cl, TmVec3 out) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float hx = L.x[i] + V.x[i], hy = L.y[i] + V.y[i], hz = L.z[i] + V.z[i];
    const float cosine = (N.x[i] * hx + N.y[i] * hy + N.z[i] * hz) * inverseLength(hx, hy, hz);
    const float positive = cosine > FLT_MIN ? cosine : FLT_MIN, within = positive < 1.0f ? positive : 1.0f;
    const float weight = share[i] * power(within, exponent[i]);
    const bool counts = (share[i] != 0.0f) & (cosine > 0.0f);
    out.x[i] += where(counts, Cl.x[i] * weight);
    out.y[i] += where(counts, Cl.y[i] * weight);
    out.z[i] += where(counts, Cl.z[i] * weight);
  }
}

}  // namespace tomales
