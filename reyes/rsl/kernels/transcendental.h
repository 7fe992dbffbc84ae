// Exponentials, trigonometric functions and the error function of one number each, without a branch and without the C
// library, whose bits differ between machines. All of them compute in double precision and round once, so a result is
// within 0.54 ulp of the true value. The polynomials are minimax fits (Remez' algorithm, relative error), none worse
// than 2e-9, which is 1/30 ulp. Infinities and NaN give what C gives; where mathematics has no value, the functions
// give what shadeops.h gives.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "reyes/shader/math.h"

namespace tomales::compiler::kernels {

constexpr double kHalfPi = 0x1.921fb54442d18p+0, kLog2OfE = 0x1.71547652b82fep+0, kLogOf2 = 0x1.62e42fefa39efp-1;
constexpr double kInfinite = std::numeric_limits<double>::infinity(), kNone = std::numeric_limits<double>::quiet_NaN();
/// Adding it to a number and subtracting it again rounds to the nearest whole number, in the low bits of the sum.
constexpr double kRounding = 0x1.8p52;

RSL_INLINE uint64_t bitsOf(double x) { return std::bit_cast<uint64_t>(x); }
RSL_INLINE double doubleOf(uint64_t bits) { return std::bit_cast<double>(bits); }
/// Returns c + x (more...), by Horner's rule.
RSL_INLINE double polynomial(double, double c) { return c; }
template <class... More>
RSL_INLINE double polynomial(double x, double c, More... more) {
  return c + x * polynomial(x, more...);
}

/// Returns 2^x; 0 or infinity if a float cannot hold it.
RSL_INLINE double exp2Of(double x) {
  const double held = x < -200 ? -200 : x > 200 ? 200 : x, sum = held + kRounding, rest = held - (sum - kRounding);
  return polynomial(rest, 1.0000000005542286, 0.69314720573750282, 0.2402264689059557, 0.055503287766818073,
                    0.0096184889600560896, 0.0013399931312495374, 0.00015345811162244401) *
         doubleOf((bitsOf(sum) << 52) + (uint64_t{1023} << 52));
}
/// Returns the logarithm of a positive, finite number, to base 2.
RSL_INLINE double plainLog2Of(float x) {
  const uint64_t bits = bitsOf(x);  // a double holds the subnormal floats as normal numbers
  const double exponent = doubleOf((bits >> 52) | bitsOf(0x1p52)) - (0x1p52 + 1023),
               mantissa = doubleOf((bits & 0xfffffffffffff) | bitsOf(1));
  const bool upper = mantissa > 0x1.6a09e667f3bcdp+0;  // the square root of 2
  const double m = upper ? 0.5 * mantissa : mantissa, s = (m - 1) / (m + 1);
  return (upper ? exponent + 1 : exponent) + s * polynomial(s * s, 2.8853900817900854, 0.9617966733409624,
                                                            0.57708358511661668, 0.41167271130592184,
                                                            0.3407302279646198);
}
/// Does so for any number that is not negative.
RSL_INLINE double log2Of(float x) {
  const double finite = x < static_cast<float>(kInfinite) ? plainLog2Of(x) : static_cast<double>(x);
  return x == 0 ? -kInfinite : finite;
}
RSL_INLINE float expOf(float x) { return static_cast<float>(exp2Of(x * kLog2OfE)); }
RSL_INLINE float logOf(float x) {
  return x <= 0 ? -std::numeric_limits<float>::max() : static_cast<float>(kLogOf2 * log2Of(x));
}
/// Tells whether plainPowOf() gives what powOf() gives.
RSL_INLINE bool isPlainPower(float x, float y) {
  const float finite = std::numeric_limits<float>::max();
  return (x > 0) & (x <= finite) & (std::abs(y) <= finite);
}
RSL_INLINE float plainPowOf(float x, float y) { return static_cast<float>(exp2Of(y * plainLog2Of(x))); }
RSL_INLINE float powOf(float x, float y) {
  const float size = std::abs(x), finite = std::numeric_limits<float>::max();
  const bool whole = rsl::wholeBelow(y) == y, odd = whole & (rsl::wholeBelow(0.5f * y) != 0.5f * y);
  const float power = rsl::chosen((size == 1) | (y == 0), 1, static_cast<float>(exp2Of(y * log2Of(size))));
  return rsl::chosen(((x < 0) & !whole & (size <= finite)) | ((x == 0) & (y < 0)), 0,
                     std::copysign(power, rsl::chosen(odd, x, 1)));
}

/// x minus the nearest whole number of quarter turns, and that number, of which only the last two bits matter.
struct Angle {
  double rest;
  uint64_t quarters;
};
/// angleOf() takes numbers below this, for which the product with the first 33 bits of half pi is exact (Cody and
/// Waite).
constexpr float kFar = 0x1p20f;
RSL_INLINE Angle angleOf(float x) {
  const double sum = x * 0x1.45f306dc9c883p-1 + kRounding, quarters = sum - kRounding;
  return {(x - quarters * 0x1.921fb544p+0) - quarters * 0x1.0b4611a626331p-34, bitsOf(sum)};
}
/// Reduces all other numbers.
Angle farAngleOf(float x);

RSL_INLINE float sineOf(Angle a) {
  const double z = a.rest * a.rest;
  const double sine = a.rest * polynomial(z, 0.99999999999544815, -0.16666666630432157, 0.0083333286888020778,
                                          -0.00019839177949669434, 2.7171490603334974e-6);
  const double cosine = polynomial(z, 0.99999999994391205, -0.49999999571365198, 0.041666613215830438,
                                   -0.0013886528637444583, 2.4372633578044117e-5);
  const uint64_t other = 0 - (a.quarters & 1);
  return static_cast<float>(doubleOf(((bitsOf(sine) & ~other) | (bitsOf(cosine) & other)) ^ ((a.quarters & 2) << 62)));
}
RSL_INLINE float cosineOf(Angle a) { return sineOf({a.rest, a.quarters + 1}); }
RSL_INLINE float tangentOf(Angle a) {
  const double z = a.rest * a.rest;
  const double sine = a.rest * polynomial(z, 0.99999999999544815, -0.16666666630432157, 0.0083333286888020778,
                                          -0.00019839177949669434, 2.7171490603334974e-6);
  const double cosine = polynomial(z, 0.99999999994391205, -0.49999999571365198, 0.041666613215830438,
                                   -0.0013886528637444583, 2.4372633578044117e-5);
  const uint64_t other = 0 - (a.quarters & 1), s = bitsOf(sine), c = bitsOf(cosine);
  return static_cast<float>(doubleOf(((s & ~other) | (c & other)) ^ (other << 63)) /
                            doubleOf((c & ~other) | (s & other)));
}

/// Returns the arctangent of a number in [0, 1].
RSL_INLINE double unitArctangentOf(double x) {
  return x * polynomial(x * x, 0.99999999994124593, -0.33333331571170629, 0.19999912048506968, -0.14283980718689059,
                        0.11093241013609598, -0.089802383343366414, 0.072457170906466064, -0.054279101224675876,
                        0.034209618285772801, -0.016111699488611732, 0.0048509459620005431, -0.00068479541009713167);
}
RSL_INLINE float atanOf(float x) {
  const double a = std::abs(x);
  const bool steep = a > 1;
  const double angle = unitArctangentOf(steep ? 1 / a : a);
  return std::copysign(static_cast<float>(steep ? kHalfPi - angle : angle), x);
}
RSL_INLINE float atan2Of(float y, float x) {
  const double ax = std::abs(x), ay = std::abs(y);
  const bool steep = ay > ax;
  const double small = steep ? ax : ay, large = steep ? ay : ax;
  const double ratio = small == large ? (large == 0 ? 0.0 : 1.0) : small / large;  // avoids 0/0 and inf/inf
  const double angle = unitArctangentOf(ratio), first = steep ? kHalfPi - angle : angle;
  return std::copysign(static_cast<float>(std::signbit(x) ? 2 * kHalfPi - first : first), y);
}
/// The arcsine of a number in [0, 1], and its complement to a right angle.
struct Arcsine {
  double value, rest;
};
RSL_INLINE Arcsine arcsineOf(double x) {
  const bool steep = x > 0.5;
  const double z = steep ? 0.5 * (1 - x) : x * x;
  const double half =
      (steep ? std::sqrt(z) : x) * polynomial(z, 0.99999999998490384, 0.16666667421652225, 0.074999381994300003,
                                              0.044662035539765813, 0.030092208689278459, 0.024711548659006519,
                                              0.0072238055595195183, 0.034951585269460476);
  return {steep ? kHalfPi - 2 * half : half, steep ? 2 * half : kHalfPi - half};
}
RSL_INLINE Arcsine arcsineOfSize(float x) {
  const double size = std::abs(x);
  return arcsineOf(size > 1 ? 1 : size);
}
RSL_INLINE float asinOf(float x) { return std::copysign(static_cast<float>(arcsineOfSize(x).value), x); }
RSL_INLINE float acosOf(float x) {
  const double rest = arcsineOfSize(x).rest;
  return static_cast<float>(x < 0 ? 2 * kHalfPi - rest : rest);
}

/// Returns erf of a number in [-1, 1].
RSL_INLINE double smallErfOf(double x) {
  return x * polynomial(x * x, 1.128379167094586, -0.37612638888502679, 0.1128379128534676, -0.026866131407463085,
                        0.0052237764007241372, -0.00085424888359581399, 0.00011954817490883131, -1.3898693347413725e-5,
                        1.0562961533863376e-6);
}
/// Returns erfc of a number in [1/2, infinity), as far as a float can hold it: exp(-x^2) / (1 + 2x) times a polynomial
/// (as Shepherd and Laframboise 1981, "Chebyshev approximation of (1+2x) exp(x^2) erfc(x)").
RSL_INLINE double largeErfcOf(double value) {
  const double x = value > 10.25 ? 10.25 : value, t = (x - 2) / (x + 2);
  return exp2Of(-kLog2OfE * x * x) / (1 + 2 * x) *
         polynomial(t, 1.2769783815503317, -0.09276382702809553, -0.16603039675118639, 0.16405132377590763,
                    -0.054220086095344818, -0.0080351683771796091, 0.0087255049566007038, 0.0012816950606159609,
                    -0.0014925260568460311, -0.00046712687000569368, 0.0003530366862748089);
}
RSL_INLINE float erfOf(float x) {
  const double a = std::abs(x);
  return std::copysign(static_cast<float>(a < 1 ? smallErfOf(a) : 1 - largeErfcOf(a)), x);
}
RSL_INLINE float erfcOf(float x) {
  const double a = std::abs(x), far = largeErfcOf(a);
  return static_cast<float>(a < 1 ? 1 - smallErfOf(x) : x < 0 ? 2 - far : far);
}

}  // namespace tomales::compiler::kernels
