// Skies that shine through windows.
#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "reyes/shade/sky.h"

namespace tomales::test {
namespace {

constexpr int kSamples = 1 << 16;
const vec3 kUp(0, 1, 0);

/// A window of width x height, `away` to the side of the origin, its sill at y = 0.
mat4 window(float width, float height, float away) {
  mat4 m(1.0f);
  m[0] = vec4(0, 0, width, 0);
  m[1] = vec4(0, height, 0, 0);
  m[2] = vec4(1, 0, 0, 0);
  m[3] = vec4(away, height / 2, 0, 1);
  return m;
}

Sky skyThrough(std::initializer_list<mat4> windows) {
  Sky sky;
  Portals portals;
  for (const mat4& m : windows) EXPECT_TRUE(portals.add(m));
  sky.setPortals(portals);
  return sky;
}

struct Estimate {
  double mean = 0, error = 0;  ///< error: rms of a single sample.
};

/// An estimate of the integral of f cos / pi over the hemisphere about N.
template <class F>
Estimate integrate(const Sky& sky, const vec3& P, const vec3& N, const F& f) {
  double sum = 0, squares = 0;
  for (uint32_t i = 0; i < kSamples; ++i) {
    float density = 0;
    const vec3 L = sky.sample(P, N, sobol2(i, 7), density);
    EXPECT_NEAR(glm::length(L), 1, 1e-4f);
    EXPECT_EQ(density, sky.density(P, N, L));
    const double x =
        dot(N, L) > 0 && density > 0 ? double{f(L)} * double{dot(N, L)} / (double{kPi} * double{density}) : 0.0;
    sum += x;
    squares += x * x;
  }
  const double mean = sum / kSamples;
  return {mean, std::sqrt(std::max(0.0, squares / kSamples - mean * mean))};
}

bool throughWindow(const vec3& L, float width, float height, float away) {
  const float t = L.x > 0 ? away / L.x : 0;
  return t > 0 && std::abs(t * L.z) <= width / 2 && t * L.y >= 0 && t * L.y <= height;
}

TEST(SkyPortals, AnOpenSkyIsAsBrightWithThemAsWithout) {
  const Sky sky = skyThrough({window(1, 1, 2), window(0.3f, 2, -0.7f)});
  for (const vec3& P : {vec3(0, 0, 0), vec3(1.9f, 0.2f, 0.3f), vec3(-5, -1, 2), vec3(3, 0.5f, 0)})
    for (const vec3& N : {kUp, vec3(1, 0, 0), glm::normalize(vec3(-1, 2, 1))})
      EXPECT_NEAR(integrate(sky, P, N, [](const vec3&) { return 1.0f; }).mean, 1, 0.01) << P.x << " " << N.x;
}

/// A rectangle parallel to the normal, its sill at the point's height (Howell, A Catalog of Radiation Heat Transfer
/// Configuration Factors, B-4).
TEST(SkyPortals, AWindowHasItsFormFactorWithATenthOfTheNoise) {
  constexpr float width = 0.6f, height = 0.5f, away = 2;
  const auto half = [](double a, double b, double c) {  // width b to one side, height c, at distance a
    const double x = a / b, y = c / b, root = std::sqrt(x * x + y * y);
    return (std::atan(1 / x) - x / root * std::atan(1 / root)) / (2 * double{kPi});
  };
  const double truth = 2 * half(away, width / 2, height);
  const auto seen = [](const vec3& L) { return throughWindow(L, width, height, away) ? 1.0f : 0.0f; };
  const Estimate with = integrate(skyThrough({window(width, height, away)}), vec3(0), kUp, seen),
                 without = integrate(Sky(), vec3(0), kUp, seen);
  EXPECT_NEAR(with.mean, truth, 0.01 * truth);
  EXPECT_NEAR(without.mean, truth, 0.1 * truth);
  EXPECT_LT(with.error, 0.1 * without.error);
}

TEST(SkyPortals, WhatIsBehindAllOfThemIsLitAsByAnOpenSky) {
  const Sky sky = skyThrough({window(1, 1, 2)});
  for (uint32_t i = 0; i < 64; ++i) {
    float density = 0, open = 0;
    const vec3 L = sky.sample(vec3(0), vec3(-1, 0, 0), sobol2(i, 3), density);
    EXPECT_EQ(L, Sky().sample(vec3(0), vec3(-1, 0, 0), sobol2(i, 3), open));
    EXPECT_EQ(density, open);
  }
}

TEST(SkyPortals, SquaresWithoutAreaAreRefused) {
  Portals portals;
  EXPECT_FALSE(portals.add(window(0, 1, 2)));
  EXPECT_FALSE(portals.add(window(std::numeric_limits<float>::quiet_NaN(), 1, 2)));
  EXPECT_TRUE(portals.all().empty());
}

}  // namespace
}  // namespace tomales::test
