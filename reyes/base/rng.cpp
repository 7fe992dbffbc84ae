#include "reyes/base/rng.h"

#include <numeric>

#include "reyes/base/simd.h"

namespace tomales {

namespace {

// Each output bit depends only on input bits up to its own place. On a bit-reversed number this is Owen's tree.
inline uint32_t laineKarras(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

// Second Sobol dimension, bits reversed. Its direction numbers are the rows of Pascal's triangle modulo 2. By Lucas's
// theorem bit i of the result is therefore the sum of those bits k of the index for which k has all bits of i. That is
// a sum over supersets, which takes one step for each of the five bits of k.
inline uint32_t sobolSecondReversed(uint32_t x) {
  x ^= (x >> 1) & 0x55555555U;
  x ^= (x >> 2) & 0x33333333U;
  x ^= (x >> 4) & 0x0f0f0f0fU;
  x ^= (x >> 8) & 0x00ff00ffU;
  x ^= x >> 16;
  return x;
}

inline uint32_t scramble(uint32_t x, uint32_t seed) { return reverseBits(laineKarras(reverseBits(x), seed)); }

// Computes the first number by Owen scrambling of a reversed number: laineKarras works on reversed bits anyway.
inline float firstOf(uint32_t shuffled, uint32_t seed) {
  return unitFloat(reverseBits(laineKarras(shuffled, hash32(seed ^ 0x9c8f2d35U))));
}
inline float secondOf(uint32_t shuffled, uint32_t seed) {
  return unitFloat(reverseBits(laineKarras(sobolSecondReversed(shuffled), hash32(seed ^ 0x1b56c4e9U))));
}
inline float onlyOf(uint32_t index, uint32_t seed) {
  return unitFloat(scramble(reverseBits(scramble(index, seed)), hash32(seed ^ 0x68bc21ebU)));
}

}  // namespace

uint32_t owenScramble(uint32_t x, uint32_t seed) { return scramble(x, seed); }

vec2 sobol2(uint32_t index, uint32_t seed) {
  const uint32_t shuffled = scramble(index, seed);
  return {firstOf(shuffled, seed), secondOf(shuffled, seed)};
}

float sobol1(uint32_t index, uint32_t seed) { return onlyOf(index, seed); }

TOMALES_HOT void sobol2(std::span<const uint32_t> index, std::span<const uint32_t> seed, std::span<vec2> out) {
  for (size_t i = 0; i < out.size(); ++i) {
    const uint32_t shuffled = scramble(index[i], seed[i]);
    out[i].x = firstOf(shuffled, seed[i]);
    out[i].y = secondOf(shuffled, seed[i]);
  }
}

TOMALES_HOT void sobol1(std::span<const uint32_t> index, std::span<const uint32_t> seed, std::span<float> out) {
  for (size_t i = 0; i < out.size(); ++i) out[i] = onlyOf(index[i], seed[i]);
}

std::vector<int> permutation(int count, uint32_t seed) {
  std::vector<int> p(static_cast<size_t>(count));
  std::iota(p.begin(), p.end(), 0);
  for (int i = count - 1; i > 0; --i)
    std::swap(p[static_cast<size_t>(i)], p[hashCombine(seed, static_cast<uint32_t>(i)) % static_cast<uint32_t>(i + 1)]);
  return p;
}

vec2 concentricDisk(const vec2& square) {
  const vec2 p = 2.0f * square - 1.0f;
  if (p == vec2(0)) return p;
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float r = wide ? p.x : p.y;
  const float angle = wide ? kPi / 4 * (p.y / p.x) : kPi / 2 - kPi / 4 * (p.x / p.y);
  return r * vec2(std::cos(angle), std::sin(angle));
}

vec3 cosineHemisphere(vec2 xi) {
  const vec2 p = concentricDisk(xi);
  return {p.x, p.y, std::sqrt(std::max(0.0f, 1.0f - p.x * p.x - p.y * p.y))};
}

}  // namespace tomales
