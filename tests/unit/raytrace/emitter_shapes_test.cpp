#include "raytrace/emitter_shapes.h"

#include <gtest/gtest.h>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

using Kind = EmitterShape::Kind;

EmitterShape square(float half, float distance) {
  return {Kind::Rectangle, {0, 0, distance}, {half, 0, 0}, {0, half, 0}, {0, 0, -1}};
}
EmitterShape tilted(Kind kind) {
  const vec3 u = glm::normalize(vec3(1, 2, 0.5f)), normal = glm::normalize(cross(u, vec3(0.3f, -0.2f, 1)));
  const vec3 v = cross(normal, u);
  const bool rectangle = kind == Kind::Rectangle;
  return {kind, {0.4f, -0.2f, 3}, u, (rectangle ? 0.3f : 1.0f) * v, normal};
}

/// Places that see the shape: near, far, grazing; some are behind it.
std::vector<vec3> eyes(const EmitterShape& s) {
  std::vector<vec3> out;
  for (uint32_t i = 0; i < 200; ++i) {
    const vec2 a = sobol2(i, 1), b = sobol2(i, 2);
    const float distance = std::pow(10.0f, 3 * a.x - 1);
    out.push_back(s.center + distance * glm::normalize(vec3(a.y, b.x, b.y) * 2.0f - 1.0f));
  }
  return out;
}

TEST(EmitterShapes, AFaceOfACubeSeenFromItsMiddleFillsASixthOfTheSphere) {
  const SeenPoint p = sampleSolidAngle(square(1, 1), vec3(0), {0.3f, 0.8f});
  EXPECT_NEAR(1 / p.pdf, 4 * kPi / 6, 1e-5f);
}

TEST(EmitterShapes, ThePlaneOfALampIsDarkOnWhicheverSideRoundingPutsItsPoints) {
  for (const Kind kind : {Kind::Rectangle, Kind::Disk}) {
    const EmitterShape lamp = tilted(kind);
    for (uint32_t i = 0; i < 200; ++i) {
      const vec2 at = sobol2(i, 3) * 1.4f - 0.7f;
      const vec3 P = lamp.center + at.x * lamp.u + at.y * lamp.v + 1e-6f * (sobol1(i, 4) - 0.5f) * lamp.normal;
      EXPECT_EQ(sampleSolidAngle(lamp, P, sobol2(i, 5)).pdf, 0);
      EXPECT_EQ(meet(lamp, P, -lamp.normal).pdf, 0);
    }
    EXPECT_GT(sampleSolidAngle(lamp, lamp.center + 1e-3f * lamp.normal, {0.5f, 0.5f}).pdf, 0);
  }
}

TEST(EmitterShapes, ASphereFillsItsCone) {
  const EmitterShape s{Kind::Sphere, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(1 / sampleSolidAngle(s, vec3(0), {0.3f, 0.8f}).pdf, 2 * kPi * (1 - std::sqrt(0.75f)), 1e-5f);
  EXPECT_EQ(sampleSolidAngle(s, {0, 0, 2.5f}, {0.3f, 0.8f}).pdf, 0) << "from inside it is dark";
}

TEST(EmitterShapes, ADiskOnItsAxisFillsItsCone) {
  const EmitterShape s{Kind::Disk, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  for (uint32_t i = 0; i < 16; ++i)
    EXPECT_NEAR(1 / sampleSolidAngle(s, vec3(0), sobol2(i, 3)).pdf, 2 * kPi * (1 - 2 / std::sqrt(5.0f)), 1e-5f);
}

class EveryShape : public ::testing::TestWithParam<Kind> {};

TEST_P(EveryShape, ShinesFromOneSideAlone) {
  const EmitterShape s = tilted(GetParam());
  if (s.kind == Kind::Sphere) return;
  for (const vec3& eye : eyes(s))
    if (const SeenPoint p = sampleSolidAngle(s, eye, {0.4f, 0.6f}); dot(eye - s.center, s.normal) < -1e-4f) {
      EXPECT_EQ(p.pdf, 0);
    }
}

TEST_P(EveryShape, ARayToASampleMeetsItWithTheSameDensity) {
  const EmitterShape s = tilted(GetParam());
  for (const vec3& eye : eyes(s))
    for (uint32_t i = 0; i < 64; ++i) {
      const SeenPoint sample = sampleSolidAngle(s, eye, sobol2(i, 5));
      if (!(sample.pdf > 0)) continue;
      const SeenPoint met = meet(s, eye, glm::normalize(sample.P - eye));
      if (met.pdf == 0) continue;  // rounding at the rim
      EXPECT_LT(glm::length(met.P - sample.P), 2e-3f * glm::length(sample.P - eye));
      EXPECT_NEAR(met.pdf / sample.pdf, 1, 2e-3f);
    }
}

/// The light of a Lambertian emitter of radiance 1 through a patch at the eye that faces it, by solid angle and by
/// area.
TEST_P(EveryShape, SendsAsMuchLightAsItsArea) {
  const EmitterShape s = tilted(GetParam());
  constexpr uint32_t kSamples = 1 << 14;
  for (const float distance : {1.5f, 4.0f, 300.0f}) {
    const vec3 eye = s.center + distance * glm::normalize(s.normal + vec3(0.6f, 0.2f, 0.1f)),
               facing = glm::normalize(s.center - eye);
    double bySolidAngle = 0, byArea = 0;
    for (uint32_t i = 0; i < kSamples; ++i) {
      const auto add = [&](const SeenPoint& p, double density, double& sum) {
        if (density > 0) sum += std::max(0.0, double{dot(glm::normalize(p.P - eye), facing)}) / density / kSamples;
      };
      const SeenPoint a = sampleSolidAngle(s, eye, sobol2(i, 7)), b = sampleArea(s, sobol2(i, 8));
      add(a, double{a.pdf}, bySolidAngle);
      add(b, solidAnglePdf(eye, b.P, b.N, double{b.pdf}), byArea);
    }
    EXPECT_NEAR(bySolidAngle / byArea, 1, 5e-3) << "from " << distance;
  }
}

/// For a disk they are equal but for the steps of its table.
TEST_P(EveryShape, SamplesStandForEqualSolidAngles) {
  const EmitterShape s = tilted(GetParam());
  for (const float distance : {1.5f, 4.0f}) {
    const vec3 eye = s.center + distance * glm::normalize(s.normal + vec3(0.6f, 0.2f, 0.1f));
    const float first = sampleSolidAngle(s, eye, {0.5f, 0.5f}).pdf;
    for (uint32_t i = 0; i < 64; ++i)
      EXPECT_NEAR(sampleSolidAngle(s, eye, sobol2(i, 5)).pdf / first, 1, s.kind == Kind::Disk ? 0.01f : 1e-4f);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryShape, ::testing::Values(Kind::Rectangle, Kind::Disk, Kind::Sphere));

}  // namespace
}  // namespace tomales
