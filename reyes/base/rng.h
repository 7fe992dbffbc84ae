// Counter-based random numbers: every number is a pure function of its purpose (pixel, point, sample, dimension, seed),
// so results never depend on the schedule of threads or buckets. Threads: everything here is pure.
#pragma once
#include <span>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// Mixes 32 bits well ("lowbias32", C. Wellons).
inline uint32_t hash32(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}
inline uint32_t hashCombine(uint32_t a, uint32_t b) {
  return hash32(a ^ (b * 0x9e3779b9U + 0x7f4a7c15U + (a << 6) + (a >> 2)));
}
template <class... Rest>
uint32_t hashCombine(uint32_t a, uint32_t b, Rest... rest) {
  return hashCombine(hashCombine(a, b), rest...);
}

/// Converts the upper 24 bits to a number in [0, 1), which is exactly representable.
inline float unitFloat(uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

inline uint32_t reverseBits(uint32_t x) {
  x = ((x >> 1) & 0x55555555U) | ((x & 0x55555555U) << 1);
  x = ((x >> 2) & 0x33333333U) | ((x & 0x33333333U) << 2);
  x = ((x >> 4) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4);
  return __builtin_bswap32(x);
}

/// Nested uniform (Owen) scrambling of the bits of x by a hash (Laine and Karras 2011, constants of
/// Burley 2020, "Practical hash-based Owen scrambling").
uint32_t owenScramble(uint32_t x, uint32_t seed);

/// Returns point `index` of the Owen-scrambled, shuffled (0,2)-sequence named by `seed`, in [0,1)^2. Any first 2^k
/// points are stratified over all elementary intervals; different seeds are independent.
vec2 sobol2(uint32_t index, uint32_t seed);

/// Returns a number of the one-dimensional companion: van der Corput, Owen-scrambled and shuffled.
float sobol1(uint32_t index, uint32_t seed);

/// Compute the same numbers for many points at once: out[i] from index[i] and seed[i].
void sobol2(std::span<const uint32_t> index, std::span<const uint32_t> seed, std::span<vec2> out);
void sobol1(std::span<const uint32_t> index, std::span<const uint32_t> seed, std::span<float> out);

/// Returns a random order of 0 .. count-1.
std::vector<int> permutation(int count, uint32_t seed);

/// Maps the unit square to the unit disk. Squares around its middle become circles, so areas stay in proportion and
/// strata keep about their shapes (Shirley and Chiu 1997, "A low distortion map between disk and square").
vec2 concentricDisk(const vec2& square);

/// Returns a direction of the hemisphere around +z with density cos(theta)/pi (Malley's method, concentricDisk()).
vec3 cosineHemisphere(vec2 xi);

}  // namespace tomales
