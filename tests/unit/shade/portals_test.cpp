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
    EXPECT_EQ(density, sky.pdf(P, N, L));
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

// A window of area A at distance d, seen at the cosine c, has the solid angle A c / d^2, and positions that are even on
// it the density d^2 / (A c) over solid angle.
TEST(SkyPortals, AreDrawnByTheirSolidAnglesAndEvenlyOverTheirAreas) {
  const vec3 P(0, 0.25f, 0), air(0);
  Portals one, two;
  EXPECT_TRUE(one.add(window(1, 0.5f, 2)) && two.add(window(1, 0.5f, 2)) && two.add(window(0.5f, 0.5f, -3)));
  EXPECT_EQ(one.share(P, air), 0.75f);
  EXPECT_NEAR(one.pdf(P, air, {1, 0, 0}), 2 * 2 / 0.5f, 1e-4f);
  const vec3 slanted = glm::normalize(vec3(2, 0, 0.4f));
  EXPECT_NEAR(one.pdf(P, air, slanted), (4 + 0.16f) / (0.5f * slanted.x), 1e-3f);
  EXPECT_EQ(one.pdf(P, air, {-1, 0, 0}), 0) << "it is in front";
  EXPECT_EQ(one.pdf(P, air, {0, 0, 1}), 0) << "along its plane";
  for (const vec3& edge : {vec3(2, 0, 0.5f), vec3(2, 0, -0.5f), vec3(2, 0.25f, 0), vec3(2, -0.25f, 0)})
    for (const float beyond : {0.99f, 1.01f})
      EXPECT_EQ(one.pdf(P, air, glm::normalize(edge * vec3(1, beyond, beyond))) > 0, beyond < 1) << edge.y << edge.z;
  const float first = 0.5f / 4, second = 0.25f / 9;
  EXPECT_NEAR(two.pdf(P, air, {1, 0, 0}), 8 * first / (first + second), 1e-3f);
  EXPECT_NEAR(two.pdf(P, air, {-1, 0, 0}), 36 * second / (first + second), 1e-3f);
  int right = 0;
  double high = 0;
  for (uint32_t i = 0; i < 4096; ++i) {
    const vec3 L = two.sample(P, air, sobol2(i, 5));
    right += L.x > 0;
    high += (L.y / std::abs(L.x) > 0) - 0.5;
    EXPECT_GT(two.pdf(P, air, L), 0);
  }
  EXPECT_NEAR(right / 4096.0, first / (first + second), 0.002);
  EXPECT_NEAR(high / 4096, 0, 0.01);
}

TEST(SkyPortals, OfASurfaceAreThoseBeforeItThatReachOverItsHorizon) {
  Portals portals;
  EXPECT_TRUE(portals.add(window(1, 0.5f, 2)));
  EXPECT_EQ(portals.share(vec3(0, 0.4f, 0), kUp), 0.75f) << "its upper tenth is over the horizon";
  EXPECT_EQ(portals.share(vec3(0, 0.6f, 0), kUp), 0);
  EXPECT_EQ(portals.share(vec3(0, 0.1f, 0), -kUp), 0.75f);
  EXPECT_EQ(portals.share(vec3(0, -0.1f, 0), -kUp), 0);
  EXPECT_EQ(portals.share(vec3(0, 0, 0), {-1, 0, 0}), 0);
}

TEST(SkyPortals, AtAWindowHalfOfAllDirectionsAreItsOwn) {
  Portals portals;  // beside one of a tenth of a steradian
  EXPECT_TRUE(portals.add(window(1, 1, 1e-3f)) && portals.add(window(1, 0.9f, -3)));
  const vec3 P(0, 0.5f, 0);
  int right = 0;
  for (uint32_t i = 0; i < 4096; ++i) right += portals.sample(P, vec3(0), sobol2(i, 5)).x > 0;
  const float other = 0.9f * 3 / std::pow(9 + 0.0025f, 1.5f);
  EXPECT_NEAR(right / 4096.0, 2 * kPi / (2 * kPi + other), 0.001);
}

TEST(SkyPortals, BehindTheHorizonGetNoSampleWhicheverOfThemComesLast) {
  Portals portals;
  EXPECT_TRUE(portals.add(window(1, 1, -2)) && portals.add(window(1, 1, 2)) && portals.add(window(1, 2, -3)));
  for (const float xi : {0.0f, 0.3f, 1.0f})  // 1 is what rounding makes of the numbers below it
    EXPECT_GT(portals.sample(vec3(0), {1, 0, 0}, {xi, 0.5f}).x, 0) << xi;
}

TEST(SkyPortals, SquaresWithoutAreaAreRefused) {
  Portals portals;
  EXPECT_FALSE(portals.add(window(0, 1, 2)));
  EXPECT_FALSE(portals.add(window(std::numeric_limits<float>::quiet_NaN(), 1, 2)));
  EXPECT_TRUE(portals.all().empty());
}

}  // namespace
}  // namespace tomales::test
