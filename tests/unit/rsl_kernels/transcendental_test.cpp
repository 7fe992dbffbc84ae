// Kernels against the C library in double precision, over dense sweeps; infinities and the like against C's own rules.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "references.h"

namespace tomales::compiler {
namespace {

constexpr int kExactBlocks = 64, kExactPoints = kExactBlocks * kBlock;

/// How far a float is from the exact value, in units of the last place of the float that is nearest to it; infinite
/// where one of them is infinite, no number or a zero of its sign and the other is not.
double errorOf(float got, double exact) {
  const auto nearest = static_cast<float>(exact);
  if (std::isnan(nearest) || std::isnan(got)) return std::isnan(nearest) == std::isnan(got) ? 0 : INFINITY;
  if (std::signbit(nearest) != std::signbit(got)) return INFINITY;
  if (std::isinf(nearest) || std::isinf(got)) return nearest == got ? 0 : INFINITY;
  const float size = std::abs(nearest);
  const double ulp = static_cast<double>(std::nextafter(size, INFINITY)) - static_cast<double>(size);
  return std::abs(static_cast<double>(got) - exact) / ulp;
}

/// The largest error in ulps where `at` gives point i of n.
template <class At, class Exact>
double largestError(Op op, int n, const At& at, const Exact& exact, float* worst = nullptr) {
  Values in(1, kExactBlocks, true), out(1, kExactBlocks, true);
  double largest = 0;
  for (int first = 0; first < n; first += kExactPoints) {
    for (int i = 0; i < kExactPoints; ++i) in.data[static_cast<size_t>(i)] = at(std::min(first + i, n - 1));
    const Lanes from = in.lanes();
    kernelOf(op)(kExactBlocks, out.lanes(), &from);
    for (size_t i = 0; i < kExactPoints; ++i) {
      const double error = errorOf(out.data[i], exact(static_cast<double>(in.data[i])));
      if (!(error <= largest)) {
        largest = error;
        if (worst) *worst = in.data[i];
      }
    }
  }
  return largest;
}
/// Evenly over an interval.
auto between(float lo, float hi, int n) {
  return [=](int i) { return lo + (hi - lo) * (static_cast<float>(i) / static_cast<float>(n - 1)); };
}
/// Over all bits, positive and negative, infinities and what is no number too.
float anyBits(int i, int n) {
  const auto bits = static_cast<uint32_t>(static_cast<uint64_t>(i) * 0xffffffffULL / static_cast<uint64_t>(n - 1));
  float f;
  std::memcpy(&f, &bits, sizeof f);
  return f;
}

constexpr int kMany = 1 << 20;

/// What transcendental.h promises.
constexpr double kLargest = 0.54;

#define EXPECT_NEAR_LIBRARY(op, function)                                                \
  do {                                                                                   \
    float worst = 0;                                                                     \
    const auto exact = [](double x) { return function; };                                \
    const double all = largestError(                                                     \
        op, kMany, [](int i) { return anyBits(i, kMany); }, exact, &worst);              \
    EXPECT_LE(all, kLargest) << "at " << worst;                                          \
    const double near = largestError(op, kMany, between(-10, 10, kMany), exact, &worst); \
    EXPECT_LE(near, kLargest) << "at " << worst;                                         \
  } while (false)

TEST(TranscendentalKernels, ExpIsTheNearestFloatButForOnesInTheMiddle) { EXPECT_NEAR_LIBRARY(Op::Exp, std::exp(x)); }
TEST(TranscendentalKernels, LogIsTheNearestFloatButForOnesInTheMiddle) { EXPECT_NEAR_LIBRARY(Op::Log, logOrLeast(x)); }
TEST(TranscendentalKernels, SinIsTheNearestFloatHoweverFarOut) { EXPECT_NEAR_LIBRARY(Op::Sin, std::sin(x)); }
TEST(TranscendentalKernels, CosIsTheNearestFloatHoweverFarOut) { EXPECT_NEAR_LIBRARY(Op::Cos, std::cos(x)); }
TEST(TranscendentalKernels, TanIsTheNearestFloatHoweverFarOut) { EXPECT_NEAR_LIBRARY(Op::Tan, std::tan(x)); }
TEST(TranscendentalKernels, AsinIsTheNearestFloat) { EXPECT_NEAR_LIBRARY(Op::Asin, std::asin(inUnit(x))); }
TEST(TranscendentalKernels, AcosIsTheNearestFloat) { EXPECT_NEAR_LIBRARY(Op::Acos, std::acos(inUnit(x))); }
TEST(TranscendentalKernels, AtanIsTheNearestFloat) { EXPECT_NEAR_LIBRARY(Op::Atan, std::atan(x)); }
TEST(TranscendentalKernels, ErfIsTheNearestFloat) { EXPECT_NEAR_LIBRARY(Op::Erf, std::erf(x)); }
TEST(TranscendentalKernels, ErfcIsTheNearestFloat) { EXPECT_NEAR_LIBRARY(Op::Erfc, std::erfc(x)); }

/// Numbers around the last that the fast reduction takes, and multiples of a right angle, where little is left.
TEST(TranscendentalKernels, SinAndCosAreTheNearestFloatsWhereTheWayOfReducingChangesAndNearTheirZeros) {
  const auto sine = [](double x) { return std::sin(x); };
  const auto cosine = [](double x) { return std::cos(x); };
  const auto border = [](int i) { return 0x1p20f + 0.0625f * static_cast<float>(i - (1 << 15)); };
  EXPECT_LE(largestError(Op::Sin, 1 << 16, border, sine), kLargest);
  EXPECT_LE(largestError(Op::Cos, 1 << 16, border, cosine), kLargest);
  const auto rightAngle = [](int i) { return static_cast<float>(1.5707963267948966 * (i - kMany / 2)); };
  EXPECT_LE(largestError(Op::Sin, kMany, rightAngle, sine), kLargest);
  EXPECT_LE(largestError(Op::Cos, kMany, rightAngle, cosine), kLargest);
}

/// The largest error of a kernel of two numbers, over n pairs.
template <class At, class Exact>
double largestErrorOfPairs(Op op, int n, const At& at, const Exact& exact, std::pair<float, float>& worst) {
  Values a(1, kExactBlocks, true), b(1, kExactBlocks, true), out(1, kExactBlocks, true);
  double largest = 0;
  for (int first = 0; first < n; first += kExactPoints) {
    for (size_t i = 0; i < kExactPoints; ++i) std::tie(a.data[i], b.data[i]) = at();
    const Lanes from[] = {a.lanes(), b.lanes()};
    kernelOf(op)(kExactBlocks, out.lanes(), from);
    for (size_t i = 0; i < kExactPoints; ++i) {
      const double error = errorOf(out.data[i], exact(static_cast<double>(a.data[i]), static_cast<double>(b.data[i])));
      if (!(error <= largest)) {
        largest = error;
        worst = {a.data[i], b.data[i]};
      }
    }
  }
  return largest;
}
double powOf(double x, double y) { return powOrZero(x, y); }
double atan2Of(double y, double x) { return std::atan2(y, x); }

TEST(TranscendentalKernels, PowIsTheNearestFloatToTheEndsOfWhatAFloatHolds) {
  Numbers numbers(3);
  std::pair<float, float> worst;
  // Exponents that bring the result to anywhere between the least and the greatest float.
  const auto wide = [&] {
    const float x = std::abs(numbers.bits()), range = std::abs(std::log2(x));
    return std::make_pair(x, numbers.within(-150, 150) / (range > 0 && range < 200 ? range : 1));
  };
  EXPECT_LE(largestErrorOfPairs(Op::Pow, kMany, wide, powOf, worst), kLargest) << worst.first << ", " << worst.second;
  const auto shading = [&] { return std::make_pair(numbers.within(0, 4), numbers.within(-20, 20)); };
  EXPECT_LE(largestErrorOfPairs(Op::Pow, kMany, shading, powOf, worst), kLargest)
      << worst.first << ", " << worst.second;
}
TEST(TranscendentalKernels, PowOfAnyBitsIsAsInCAndZeroWhereThereIsNoPower) {
  Numbers numbers(4);
  std::pair<float, float> worst;
  const auto any = [&] { return std::make_pair(numbers.any(), numbers.any()); };
  EXPECT_LE(largestErrorOfPairs(Op::Pow, kMany, any, powOf, worst), kLargest) << worst.first << ", " << worst.second;
}
TEST(TranscendentalKernels, PowHasTheSameBitsWhateverStandsBesideIt) {
  Values x(1, 1, true), y(1, 1, true), alone(1, 1, true), beside(1, 1, true);
  const Lanes from[] = {x.lanes(), y.lanes()};
  Numbers numbers(6);
  for (int round = 0; round < 1000; ++round) {
    for (size_t k = 0; k < kBlock; ++k) {
      x.data[k] = round % 10 == 0 ? 1 : std::abs(numbers.bits());
      y.data[k] = round % 10 == 1 ? 0 : numbers.within(-20, 20);
    }
    kernelOf(Op::Pow)(1, alone.lanes(), from);
    x.data[0] = round % 2 == 0 ? 0 : -1;
    kernelOf(Op::Pow)(1, beside.lanes(), from);
    for (size_t k = 1; k < kBlock; ++k)
      EXPECT_EQ(std::bit_cast<uint32_t>(alone.data[k]), std::bit_cast<uint32_t>(beside.data[k]))
          << "pow(" << x.data[k] << ", " << y.data[k] << ")";
  }
}
TEST(TranscendentalKernels, Atan2OfAnyBitsIsAsInC) {
  Numbers numbers(5);
  std::pair<float, float> worst;
  const auto any = [&] { return std::make_pair(numbers.any(), numbers.any()); };
  EXPECT_LE(largestErrorOfPairs(Op::Atan2, kMany, any, atan2Of, worst), kLargest)
      << worst.first << ", " << worst.second;
  const auto bits = [&] { return std::make_pair(numbers.bits(), numbers.bits()); };
  EXPECT_LE(largestErrorOfPairs(Op::Atan2, kMany, bits, atan2Of, worst), kLargest)
      << worst.first << ", " << worst.second;
}

TEST(TranscendentalKernels, WholePowersAndRootsAreExact) {
  Values x(1, 1, true), y(1, 1, true), out(1, 1, true);
  for (size_t k = 0; k < kBlock; ++k) {
    x.data[k] = static_cast<float>(k);
    y.data[k] = 3;
  }
  const Lanes from[] = {x.lanes(), y.lanes()};
  kernelOf(Op::Pow)(1, out.lanes(), from);
  for (size_t k = 0; k < kBlock; ++k) EXPECT_EQ(out.data[k], static_cast<float>(k * k * k));
  for (size_t k = 0; k < kBlock; ++k) {
    x.data[k] = static_cast<float>(k * k);
    y.data[k] = 0.5f;
  }
  kernelOf(Op::Pow)(1, out.lanes(), from);
  for (size_t k = 0; k < kBlock; ++k) EXPECT_EQ(out.data[k], static_cast<float>(k));
}

}  // namespace
}  // namespace tomales::compiler
