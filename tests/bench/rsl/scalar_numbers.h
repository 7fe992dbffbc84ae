// The numbers of loops/ for one point: those of C++.
#pragma once
#include <cmath>

#include "reyes/shader/noise.h"

#define HWY_INLINE inline
#define HWY_ATTR

namespace tomales::bench::fused {

using F = float;
using B = bool;
constexpr int kWidth = 1;

inline F load(const float* from, int i) { return from[i]; }
inline void store(float* to, int i, F x) { to[i] = x; }
inline F select(B c, F a, F b) { return c ? a : b; }
inline F floorOf(F x) { return std::floor(x); }
inline F sqrtOf(F x) { return std::sqrt(x); }
inline F absOf(F x) { return std::abs(x); }
inline F minOf(F a, F b) { return std::min(a, b); }
inline F maxOf(F a, F b) { return std::max(a, b); }
inline F expOf(F x) { return std::exp(x); }
inline F powOf(F x, F y) { return std::pow(x, y); }
inline F sinOf(F x) { return std::sin(x); }
inline F cosOf(F x) { return std::cos(x); }
inline F tanOf(F x) { return std::tan(x); }
inline F acosOf(F x) { return std::acos(x); }
inline F atanOf(F y, F x) { return std::atan2(y, x); }
inline F noise(F x, F y, F z) { return rsl::noise({x, y, z}); }
inline F cellnoise(F x, F y, F z) { return rsl::cellnoise({x, y, z}); }
inline F lookUp(const float* table, F index) { return table[static_cast<int>(index)]; }
inline bool any(B c) { return c; }
template <class Then, class Else>
auto pick(B c, const Then& then, const Else& otherwise) {
  return c ? then() : otherwise();
}

}  // namespace tomales::bench::fused
