#include <gtest/gtest.h>

#include "reyes/image.h"

namespace tomales {
namespace {

const char* const kNames[] = {"box",   "triangle", "gaussian",        "catmull-rom", "separable-catmull-rom",
                              "sinc",  "mitchell", "blackman-harris", "lanczos",     "disk",
                              "bessel"};

double integral(const PixelFilter& filter, double halfWidth) {
  const int n = 400;
  const double step = 2 * halfWidth / n;
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      sum += static_cast<double>(
          filter(static_cast<float>(-halfWidth + (i + 0.5) * step), static_cast<float>(-halfWidth + (j + 0.5) * step)));
  return sum * step * step;
}

TEST(PixelFilter, EveryNamedFilterIsKnownAndOtherNamesAreNot) {
  bool known = false;
  for (const char* name : kNames) {
    const PixelFilter filter(name, 4, 4, &known);
    EXPECT_TRUE(known) << name;
    EXPECT_GT(filter(0, 0), 0) << name;
  }
  const PixelFilter substitute("gausian", 2, 2, &known);
  EXPECT_FALSE(known);
  EXPECT_FLOAT_EQ(substitute(0.5f, 0.25f), PixelFilter("gaussian", 2, 2)(0.5f, 0.25f));
}

TEST(PixelFilter, IsEvenAndZeroBeyondItsWidth) {
  for (const char* name : kNames) {
    const PixelFilter filter(name, 4, 3);
    EXPECT_FLOAT_EQ(filter(0.7f, -0.4f), filter(-0.7f, 0.4f)) << name;
    EXPECT_EQ(filter(2.01f, 0), 0) << name;
    EXPECT_EQ(filter(0, -1.51f), 0) << name;
  }
}

TEST(PixelFilter, IntegralsAreThoseOfTheirFormulas) {
  EXPECT_NEAR(integral(PixelFilter("box", 3, 3), 1.5), 9, 1e-3);
  EXPECT_NEAR(integral(PixelFilter("triangle", 3, 3), 1.5), 1.5 * 1.5, 1e-3);
  const double g = std::sqrt(std::acos(-1.0) / 2) * std::erf(std::sqrt(2.0));  // of exp(-2 x^2) over [-1, 1]
  EXPECT_NEAR(integral(PixelFilter("gaussian", 2, 2), 1), g * g, 1e-3);
  EXPECT_NEAR(integral(PixelFilter("separable-catmull-rom", 4, 4), 2), 4,
              1e-2);  // each axis twice the unit kernel
  EXPECT_NEAR(integral(PixelFilter("mitchell", 4, 4), 2), 1, 1e-3);
  EXPECT_NEAR(integral(PixelFilter("disk", 2, 2), 1), std::acos(-1.0), 2e-2);
}

TEST(PixelFilter, TriangleNeverTurnsNegativeInWideFilters) {
  const PixelFilter filter("triangle", 6, 6);
  for (float x = -3; x < 3; x += 0.1f) EXPECT_GE(filter(x, 0), -1e-6f);
}

TEST(PixelFilter, ReachIsThePixelsThatTheFilterTouches) {
  EXPECT_EQ(PixelFilter("box", 1, 1).reachX(), 0);
  EXPECT_EQ(PixelFilter("box", 2, 1).reachX(), 1);
  EXPECT_EQ(PixelFilter("box", 3, 4).reachX(), 1);
  EXPECT_EQ(PixelFilter("box", 3, 4).reachY(), 2);
}

TEST(PixelFilter, WidthsThatWouldLoseSamplesAreWidenedToOnePixel) {
  EXPECT_GT(PixelFilter("box", 0.1f, -1)(0.45f, 0.45f), 0);
}

}  // namespace
}  // namespace tomales
