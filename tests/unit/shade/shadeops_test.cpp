// Shadeops against closed forms and against scalar references written here, in double precision where that says
// something.
#include "reyes/shader/shadeops.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>

namespace {

using rsl::Vec3;
constexpr double kPi = 3.14159265358979323846;

class Values {
 public:
  float operator()(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(engine_); }
  Vec3 vec(float size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }

 private:
  std::mt19937 engine_{7};
};

void expectNear(Vec3 is, Vec3 should, float tolerance) {
  EXPECT_NEAR(is.x, should.x, tolerance);
  EXPECT_NEAR(is.y, should.y, tolerance);
  EXPECT_NEAR(is.z, should.z, tolerance);
}

TEST(Shadeops, ModTakesTheSignOfItsDivisorAndStepsStepAtTheirEdge) {
  EXPECT_FLOAT_EQ(rsl::mod(-0.25f, 1), 0.75f);
  EXPECT_FLOAT_EQ(rsl::mod(0.25f, -1), -0.75f);
  EXPECT_EQ(rsl::sign(-3), -1);
  EXPECT_EQ(rsl::sign(0), 0);
  EXPECT_EQ(rsl::step(0.5f, 0.49f), 0);
  EXPECT_EQ(rsl::step(0.5f, 0.5f), 1);
  EXPECT_FLOAT_EQ(rsl::log(8, 2), 3);
  EXPECT_FLOAT_EQ(rsl::degrees(rsl::radians(33)), 33);
}

TEST(Shadeops, FilterstepIsTheMeanOfStepOverItsWidth) {
  Values any;
  for (int k = 0; k < 50; ++k) {
    const float edge = any(0, 1), x = any(0, 1), width = any(0.01f, 1);
    double mean = 0;
    for (int i = 0; i < 4000; ++i) mean += rsl::step(edge, x + width * float((i + 0.5) / 4000 - 0.5)) / 4000.0;
    EXPECT_NEAR(rsl::filterstep(edge, x, width), mean, 1e-3);
  }
}

TEST(Shadeops, RotateKeepsTheAxisAndTurnsByTheAngle) {
  expectNear(rsl::rotate(Vec3{1, 0, 0}, float(kPi / 2), {}, {0, 0, 5}), {0, 1, 0}, 1e-6f);
  expectNear(rsl::rotate(Vec3{3, 1, 1}, float(kPi), {1, 1, 1}, {1, 2, 1}), {-1, 1, 1}, 1e-5f);
  EXPECT_FLOAT_EQ(rsl::ptlined({0, 0, 0}, {2, 0, 0}, {1, 3, 0}), 3);
  EXPECT_FLOAT_EQ(rsl::ptlined({0, 0, 0}, {2, 0, 0}, {5, 4, 0}), 5);
}

// Snell's law and energy: Schlick-free Fresnel by both polarisations, in angles.
TEST(Shadeops, FresnelFollowsTheAnglesOfSnellsLaw) {
  for (double in = 0.05; in < 1.5; in += 0.1)
    for (const double eta : {1 / 1.5, 1 / 1.1, 1.3}) {
      const Vec3 I{float(std::sin(in)), 0, float(-std::cos(in))}, N{0, 0, 1};
      float Kr, Kt;
      Vec3 R, T;
      rsl::fresnel(I, N, float(eta), Kr, Kt, R, T);
      expectNear(R, {float(std::sin(in)), 0, float(std::cos(in))}, 1e-5f);
      const double sine = eta * std::sin(in);
      if (sine >= 1) {
        EXPECT_EQ(Kr, 1);
        EXPECT_EQ(rsl::length(T), 0);
        continue;
      }
      const double out = std::asin(sine), s = std::sin(in - out) / std::sin(in + out),
                   p = std::tan(in - out) / std::tan(in + out);
      EXPECT_NEAR(Kr, 0.5 * (s * s + p * p), 1e-4);
      EXPECT_NEAR(Kr + Kt, 1, 1e-6);
      expectNear(T, {float(std::sin(out)), 0, float(-std::cos(out))}, 1e-4f);
    }
}

TEST(Shadeops, MatricesTurnMoveAndScaleAsRibDoes) {
  // Translate 1 2 3, then Scale 2 2 2: the last request acts first.
  const rsl::Matrix m = rsl::scale(rsl::translate({}, {1, 2, 3}), {2, 2, 2});
  expectNear(rsl::transform(m, {1, 1, 1}), {3, 4, 5}, 1e-6f);
  expectNear(rsl::vtransform(m, {1, 1, 1}), {2, 2, 2}, 1e-6f);
  EXPECT_FLOAT_EQ(rsl::determinant(m), 8);
  expectNear(rsl::transform(rsl::rotate({}, float(kPi / 2), {0, 0, 1}), {1, 0, 0}), {0, 1, 0}, 1e-6f);
}

TEST(Shadeops, InverseUndoesAndNormalsStayAcrossTheirTangents) {
  Values any;
  for (int k = 0; k < 50; ++k) {
    const rsl::Matrix m =
        rsl::rotate(rsl::scale(rsl::translate({}, any.vec(3)), {any(0.5f, 2), any(0.5f, 2), any(-2, -0.5f)}),
                    any(-3, 3), any.vec(1));
    rsl::Matrix inverse;
    ASSERT_NE(rsl::invert(m, &inverse), 0);
    const Vec3 p = any.vec(2);
    expectNear(rsl::transform(inverse, rsl::transform(m, p)), p, 1e-4f);
    const Vec3 n = any.vec(1), tangent = rsl::cross(n, any.vec(1));
    EXPECT_NEAR(rsl::dot(rsl::ntransform(m, n), rsl::vtransform(m, tangent)), 0, 1e-4f);
  }
  EXPECT_EQ(rsl::determinant(rsl::scale({}, {1, 0, 1})), 0);
}

TEST(Shadeops, ColoursComeBackFromEverySpace) {
  Values any;
  for (const char* space : {"hsv", "hsl", "YIQ", "xyz", "xyY", "rgb"})
    for (int k = 0; k < 100; ++k) {
      const Vec3 c{any(0.01f, 1), any(0.01f, 1), any(0.01f, 1)};
      expectNear(rsl::ctransform(space, "rgb", rsl::ctransform("rgb", space, c)), c, 2e-3f);
    }
  expectNear(rsl::ctransform("rgb", "hsv", {0, 1, 0}), {1.0f / 3, 1, 1}, 1e-6f);
  expectNear(rsl::ctransform("rgb", "hsl", {1, 0.5f, 0.5f}), {0, 1, 0.75f}, 1e-6f);
  expectNear(rsl::ctransform("rgb", "xyz", {1, 1, 1}), {0.9505f, 1, 1.0891f}, 1e-3f);  // D65
  expectNear(rsl::ctransform("rgb", "YIQ", {1, 1, 1}), {1, 0, 0}, 1e-4f);
}

// --- Noise

TEST(Noise, OfAllDimensionsIsBetween0And1AndHalfOnTheLattice) {
  Values any;
  float lo = 1, hi = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vec3 p = any.vec(50);
    for (const float n : {rsl::noise(p.x), rsl::noise(p.x, p.y), rsl::noise(p), rsl::noise(p, p.x * 0.7f)}) {
      EXPECT_GE(n, 0);
      EXPECT_LE(n, 1);
      lo = std::min(lo, n);
      hi = std::max(hi, n);
    }
  }
  EXPECT_LT(lo, 0.2f);
  EXPECT_GT(hi, 0.8f);
  EXPECT_EQ(rsl::noise(Vec3{3, -4, 5}), 0.5f);
  EXPECT_EQ(rsl::noise(Vec3{3, -4, 5}, 2), 0.5f);
}

TEST(Noise, HasTheMeanAndSmoothnessOfNoiseInEveryDimension) {
  double sum[4] = {};
  constexpr int n = 4000;
  for (int k = 0; k < n; ++k) {
    const float x = 0.173f * float(k);
    const Vec3 p{x, 1.3f * x + 0.1f, 0.71f * x};
    const std::array<float, 4> here = {rsl::noise(x), rsl::noise(x, p.y), rsl::noise(p), rsl::noise(p, p.z + 0.4f)};
    const Vec3 q = p + Vec3{1e-3f, 0, 0};
    const std::array<float, 4> near = {rsl::noise(x + 1e-3f), rsl::noise(q.x, p.y), rsl::noise(q),
                                       rsl::noise(q, p.z + 0.4f)};
    for (size_t d = 0; d < 4; ++d) {
      sum[d] += here[d];
      EXPECT_NEAR(here[d], near[d], 5e-3f);
    }
  }
  for (const double s : sum) EXPECT_NEAR(s / n, 0.5, 0.03);
}

// Perlin's noise over one lattice cell, spelt out in double precision from the hash of the header.
TEST(Noise, OfThreeDimensionsIsPerlinsByItsDefinition) {
  Values any;
  for (int k = 0; k < 200; ++k) {
    const Vec3 p = any.vec(20);
    const double f[3] = {p.x - std::floor(double(p.x)), p.y - std::floor(double(p.y)), p.z - std::floor(double(p.z))};
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const int c[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
      double weight = 1;
      Vec3 offset;
      float* o[3] = {&offset.x, &offset.y, &offset.z};
      for (int a = 0; a < 3; ++a) {
        const double fade = f[a] * f[a] * f[a] * (f[a] * (f[a] * 6 - 15) + 10);
        weight *= c[a] ? fade : 1 - fade;
        *o[a] = float(f[a] - c[a]);
      }
      const uint32_t hash =
          rsl::latticeHash(int(std::floor(p.x)) + c[0], int(std::floor(p.y)) + c[1], int(std::floor(p.z)) + c[2]);
      sum += weight * double(rsl::gradient(hash, offset));
    }
    EXPECT_NEAR(rsl::signedNoise(p), sum, 2e-5);
    EXPECT_NEAR(rsl::signedPeriodicNoise(p, {}), sum, 2e-5);
  }
}

TEST(Noise, RepeatsWithItsPeriodAndIsSmoothAcrossIt) {
  Values any;
  for (int k = 0; k < 300; ++k) {
    const Vec3 p = any.vec(9), period{3, 5, 7};
    const float t = any(-9, 9);
    EXPECT_NEAR(rsl::pnoise(p, period), rsl::pnoise(p + Vec3{3, -5, 14}, period), 2e-4f);
    EXPECT_NEAR(rsl::pnoise(p, t, period, 4), rsl::pnoise(p + Vec3{-3, 5, 7}, t + 8, period, 4), 2e-4f);
    EXPECT_NEAR(rsl::pnoise(p.x, 4), rsl::pnoise(p.x + 12, 4), 2e-4f);
    EXPECT_NEAR(rsl::pnoise(p.x, p.y, 4, 2), rsl::pnoise(p.x - 4, p.y + 2, 4, 2), 2e-4f);
    EXPECT_NEAR(rsl::pnoise(Vec3{3 - 1e-4f, p.y, p.z}, period), rsl::pnoise(Vec3{1e-4f, p.y, p.z}, period), 1e-3f);
  }
}

TEST(Noise, OfCellsIsConstantInThemAndEvenlySpread) {
  int histogram[4] = {};
  for (int k = 0; k < 4000; ++k) {
    const Vec3 cell{float(k % 17 - 8), float(k % 29 - 14), float(k)};
    const float n = rsl::cellnoise(cell + Vec3{0.1f, 0.2f, 0.3f});
    EXPECT_EQ(n, rsl::cellnoise(cell + Vec3{0.9f, 0.8f, 0.7f}));
    ASSERT_GE(n, 0);
    ASSERT_LT(n, 1);
    ++histogram[int(4 * n)];
  }
  for (const int h : histogram) EXPECT_NEAR(h, 1000, 150);
  const Vec3 three = rsl::cellnoise3({1, 2, 3});
  EXPECT_NE(three.x, three.y);
  EXPECT_NE(three.y, three.z);
}

// The bits that pictures depend on.
TEST(Noise, IsTheSameOnEveryMachine) {
  uint32_t bits = 0;
  for (int k = 0; k < 1000; ++k) {
    const float x = 0.37f * float(k);
    for (const float n : {rsl::noise(Vec3{x, 2 * x, -x}), rsl::noise(Vec3{x, x, x}, -x),
                          rsl::pnoise(Vec3{x, x, 0.5f}, {7, 7, 7}), rsl::cellnoise(x)}) {
      uint32_t b;
      std::memcpy(&b, &n, 4);
      bits = bits * 31 + b;
    }
  }
  EXPECT_EQ(bits, 3266858238U) << "a change of these bits changes every procedural picture";
}

// --- Splines

// de Boor's and de Casteljau's constructions, and the Hermite conditions.
TEST(Splines, OfAllBasesFollowTheirConstructions) {
  const float k[4] = {1, 3, -2, 5};
  for (float t = 0; t <= 1; t += 0.125f) {
    const auto lerp = [t](double a, double b) { return a + (b - a) * double(t); };
    const double a = lerp(k[0], k[1]), b = lerp(k[1], k[2]), c = lerp(k[2], k[3]);
    EXPECT_NEAR(rsl::spline(rsl::Basis::Bezier, t, k, 4), lerp(lerp(a, b), lerp(b, c)), 1e-5);
    EXPECT_NEAR(rsl::spline(rsl::Basis::Linear, t, k, 4), lerp(k[1], k[2]), 1e-5);
    // Catmull-Rom is Hermite with half the chords as tangents.
    const float hermite[4] = {k[1], (k[2] - k[0]) / 2, k[2], (k[3] - k[1]) / 2};
    EXPECT_NEAR(rsl::spline(rsl::Basis::CatmullRom, t, k, 4), rsl::spline(rsl::Basis::Hermite, t, hermite, 4), 1e-5);
    // Cubic B-spline by de Boor, knots ... -2 -1 0 1 2 3.
    double d[4] = {k[0], k[1], k[2], k[3]};
    for (int r = 1; r <= 3; ++r)
      for (int j = 3; j >= r; --j) {
        const double lo = j - 3, alpha = (double(t) - lo) / (4 - r);
        d[j] = (1 - alpha) * d[j - 1] + alpha * d[j];
      }
    EXPECT_NEAR(rsl::spline(rsl::Basis::BSpline, t, k, 4), d[3], 1e-5);
  }
}

TEST(Splines, OfManyKnotsPassThroughTheInnerOnesAndClamp) {
  const float k[7] = {0, 1, 4, 2, 8, 5, 7};
  for (int i = 1; i <= 5; ++i) EXPECT_NEAR(rsl::spline(rsl::Basis::CatmullRom, float(i - 1) / 4, k, 7), k[i], 1e-5f);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(rsl::spline(rsl::Basis::Bezier, float(i) / 2, k, 7), k[3 * i], 1e-5f);
  EXPECT_EQ(rsl::spline(rsl::Basis::CatmullRom, 2, k, 7), k[5]);
  EXPECT_EQ(rsl::spline(rsl::Basis::CatmullRom, -1, k, 7), k[1]);
  expectNear(rsl::spline(0.5f, {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{}}), {0.5625f, 0.5625f, 0}, 1e-6f);
  EXPECT_EQ(rsl::basisNamed("b-spline"), rsl::Basis::BSpline);
}

TEST(Splines, AreInvertedWhereTheyRiseOrFall) {
  const float rises[6] = {-1, 0, 1, 3, 6, 10}, falls[6] = {10, 6, 3, 1, 0, -1};
  for (float x = 0; x <= 1; x += 0.1f)
    for (const float* k : {rises, falls})
      EXPECT_NEAR(rsl::solveSpline(rsl::Basis::CatmullRom, rsl::spline(rsl::Basis::CatmullRom, x, k, 6), k, 6), x,
                  1e-4f);
}

}  // namespace
