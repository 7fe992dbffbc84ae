#include "reyes/hide/aperture.h"

#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

/// Distance from the centre to the side of a regular polygon in direction p, its first corner at `turn`.
float chordAlong(const vec2& p, float sides, float turn) {
  const float wedge = 2 * kPi / sides;
  float angle = std::fmod(std::atan2(p.y, p.x) - turn, wedge);
  if (angle < 0) angle += wedge;
  return std::cos(wedge / 2) / std::cos(angle - wedge / 2);
}

TEST(Aperture, APolygonIsFilledEvenlyUpToItsSides) {
  for (const float sides : {3.0f, 5.0f, 8.0f})
    for (const float degrees : {0.0f, 20.0f}) {
      const ApertureShape shape({sides, degrees, 0, 0});
      int inner = 0;
      vec2 sum(0);
      float farthest = 0;
      const int n = 1 << 14;
      for (uint32_t i = 0; i < n; ++i) {
        const vec2 p = shape(sobol2(i, 3));
        const float r = glm::length(p) / chordAlong(p, sides, degrees * kPi / 180);
        ASSERT_LE(r, 1.001f);
        farthest = std::max(farthest, r);
        inner += r < std::sqrt(0.5f);
        sum += p;
      }
      EXPECT_GT(farthest, 0.99f);
      EXPECT_NEAR(static_cast<double>(inner) / n, 0.5, 0.002) << "half of the area, half of the points";
      EXPECT_LT(glm::length(sum) / n, 0.003f);
      // Uniform in angle by area: the share of the first side is that of its sector.
      int first = 0;
      for (uint32_t i = 0; i < n; ++i) {
        const vec2 p = shape(sobol2(i, 3));
        float angle = std::atan2(p.y, p.x) - degrees * kPi / 180;
        if (angle < 0) angle += 2 * kPi;
        first += angle < kPi / sides;  // the first half of the first side
      }
      EXPECT_NEAR(static_cast<double>(first) / n, 0.5 / sides, 0.004);
    }
}

TEST(Aperture, RoundnessBendsTheSidesOutToTheRimAndInAsMuch) {
  const auto farthestAtMiddle = [](float roundness) {
    const ApertureShape shape({4, 0, roundness, 0});
    float farthest = 0;
    for (uint32_t i = 0; i < 1 << 14; ++i) {
      const vec2 p = shape(sobol2(i, 3));
      if (std::abs(std::atan2(p.y, p.x) - kPi / 4) < 0.02f) farthest = std::max(farthest, glm::length(p));
    }
    return farthest;
  };
  const float chord = std::cos(kPi / 4);
  EXPECT_NEAR(farthestAtMiddle(1), 1, 0.02f);
  EXPECT_NEAR(farthestAtMiddle(0), chord, 0.02f);
  EXPECT_NEAR(farthestAtMiddle(-1), 2 * chord - 1, 0.02f);
}

TEST(Aperture, DensityMovesLightBetweenCentreAndRim) {
  // Density w = 1 + d (2r - 1) on a disk: the share inside radius r is (r^2 (1 - d) / 2 + 2 d r^3 / 3) / (1/2 + d/6).
  for (const float d : {-1.0f, 0.0f, 0.7f, 1.0f}) {
    const ApertureShape shape({0, 0, 0, d});
    int inside = 0;
    for (uint32_t i = 0; i < 1 << 14; ++i) inside += glm::length(shape(sobol2(i, 3))) < 0.5f;
    const double expected = (0.125 * (1 - d) + d / 12) / (0.5 + d / 6);
    EXPECT_NEAR(static_cast<double>(inside) / (1 << 14), expected, 0.003) << d;
  }
}

// A thin lens of radius 2.5 focused at 5, and a square of a pixel at 20, on the axis: 32 px stand for an angle of 45
// degrees.
TEST(Aperture, ADefocusedPointTakesItsShape) {
  Options o;
  o.xResolution = o.yResolution = 64;
  o.projection = ProjectionKind::Perspective;
  o.focalDistance = 5;
  o.focalLength = 5;
  o.fStop = 1;
  o.dofAspect = 1.44f;
  World w(o);
  w.add();
  w.freeze();
  const PixelRect all{0, 0, 64, 64};
  const vec2 radius = 32 * 2.5f * (1 / 5.0f - 1 / 20.0f) * vec2(1.2f, 1 / 1.2f);
  double energy = 0, middle = 0;
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const SamplePattern pattern(8, 8, true, seed, {3, 90, 0, 0});
    const auto square = [](float u, float v, int) { return vec3((u - 0.5f) / 32 * 20, (0.5f - v) / 32 * 20, 20); };
    const DeepTile t = hide(w, pattern, all, {raster(w, makeGrid(0, 1, 2, 2, square))});
    forSamples(pattern, all, [&](int x, int y, int s, vec2 p, float) {
      if (!hits(t, x, y, s)) return;
      const vec2 unit = (p - vec2(32)) * vec2(1, -1) / radius;
      energy += 1.0 / 64;
      ASSERT_LT(glm::length(unit), chordAlong(unit, 3, kPi / 2) + 0.12f) << "half a pixel about the point";
      middle += glm::length(unit) < 0.5f * chordAlong(unit, 3, kPi / 2) ? 1.0 / 64 : 0;
    });
  }
  EXPECT_NEAR(energy / 20, 1, 0.1);
  EXPECT_NEAR(middle / energy, 0.25, 0.05);
}

}  // namespace
}  // namespace tomales::test
