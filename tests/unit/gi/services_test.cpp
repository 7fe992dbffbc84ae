#include "gi/services.h"

#include <gtest/gtest.h>

#include "reyes/base/parallel.h"
#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;

// Inside a sphere every point sees every other with the same form factor: one bounce gives E/pi = rho I / R^2
// everywhere, wherever the point light is, and each further bounce rho times the last.
constexpr float kBallRadius = 2, kBallAlbedo = 0.5f, kBallIntensity = 3,
                kOneBounce = kBallAlbedo * kBallIntensity / (kBallRadius * kBallRadius);

Scene litBall(const vec3& light, int resolution = 64) {
  SceneBuilder b(resolution);
  b.light("pointlight", {floatParam("intensity", kBallIntensity), pointParam("from", light)});
  b.light("indirectlight", {});
  b.sphere(kBallRadius, vec3(kBallAlbedo), {0, 0, 0.5f});
  return b.scene;
}

ShadePoints pointsInside() {
  ShadePoints points(0, 0);
  for (uint32_t i = 0; i < 4; ++i) {
    const vec3 d = glm::normalize(vec3(static_cast<float>(i) - 1.5f, 0.5f, 1));
    const int k = points.add(i + 1);
    points.set3(kPx, k, vec3(0, 0, 0.5f) + kBallRadius * d);
    points.set3(kNx, k, d);
    points.set3(kNgx, k, d);
    points.set3(kIx, k, d);
  }
  return points;
}

TEST(GiServices, ModeNoneGivesNoIndirectLight) {
  World world(litBall({0, 0, 0.5f}));
  const auto services = world.use({.mode = GiMode::None});
  for (const vec3& E : indirectAt(*services, pointsInside(), {})) EXPECT_EQ(E, vec3(0));
}

TEST(GiServices, AGatheredFurnaceIsUniform) {
  World world(litBall({0, 0, 0.5f}));
  const auto services = world.use({.mode = GiMode::Gather});
  IndirectQuery query;
  query.samples = 200;
  for (const vec3& E : indirectAt(*services, pointsInside(), query)) EXPECT_NEAR(E.x, kOneBounce, 0.02f * kOneBounce);
}

// The true surface lies behind the polygons that rays see: flat rays must not pass behind these.
TEST(GiServices, NoRayLeavesAClosedSphere) {
  Scene scene = litBall({0, 0, 0.5f});
  auto glowing = std::make_shared<Attributes>(*scene.objects[0].attributes);
  glowing->surface = std::make_shared<ShaderCall>(call("constant"));
  scene.objects[0].attributes = glowing;
  World world(std::move(scene));
  IndirectQuery query;
  query.samples = 4000;
  for (const GiMode mode : {GiMode::Gather, GiMode::Reference})
    for (const vec3& E : indirectAt(*world.use({.mode = mode}), pointsInside(), query))
      EXPECT_NEAR(E.x, kBallAlbedo, 2e-3f * kBallAlbedo);
}

TEST(GiServices, GatherAndReferenceAgreeWithTheIntegratingSphereForALightOffCentre) {
  World world(litBall({0.6f, -0.5f, 1.0f}));
  IndirectQuery query;
  query.samples = 4000;
  for (const GiMode mode : {GiMode::Gather, GiMode::Reference}) {
    const auto services = world.use({.mode = mode});
    for (const vec3& E : indirectAt(*services, pointsInside(), query)) EXPECT_NEAR(E.x, kOneBounce, 0.03f * kOneBounce);
  }
}

TEST(GiServices, ReferenceBouncesAddUpAsAGeometricSeries) {
  World world(litBall({0, 0, 0.5f}));
  IndirectQuery query;
  query.samples = 256;
  float expected = 0;
  for (int bounces = 1; bounces <= 4; ++bounces) {
    expected += kOneBounce * std::pow(kBallAlbedo, static_cast<float>(bounces - 1));
    const auto services = world.use({.mode = GiMode::Reference, .bounces = bounces});
    const int64_t before = world.stats.rays.reference;
    for (const vec3& E : indirectAt(*services, pointsInside(), query))
      EXPECT_NEAR(E.x, expected, 0.025f * expected) << bounces;
    // Paths do not branch: each has one ray a bounce, except for the few that slip out through the coarse sphere.
    EXPECT_LE(world.stats.rays.reference - before, 4 * 256 * bounces);
    EXPECT_GT(world.stats.rays.reference - before, 4 * 250 * bounces);
  }
}

TEST(GiServices, GatheredBouncesAddUpAsAGeometricSeries) {
  World world(litBall({0.6f, -0.5f, 1.0f}, 48));
  const DeepFrame frame = frameOf(world, 16);
  IndirectQuery query;
  for (const auto& [bounces, cached] : {std::pair(2, false), std::pair(2, true), std::pair(4, true)}) {
    const float expected = kOneBounce * (1 - std::pow(kBallAlbedo, static_cast<float>(bounces))) / (1 - kBallAlbedo);
    const auto services = world.use({.mode = GiMode::Gather, .samples = 400, .bounces = bounces});
    if (cached) gatherFrame(*services, frame);  // else hits find no record and go on as paths
    const int64_t before = world.stats.rays.reference;
    for (const vec3& E : indirectAt(*services, pointsInside(), query))
      EXPECT_NEAR(E.x, expected, 0.03f * expected) << bounces << (cached ? " cached" : " traced");
    const int64_t paths = world.stats.rays.reference - before;
    EXPECT_GT(paths, cached ? -1 : 4 * 390);
    EXPECT_LT(paths, cached ? 4 * 60 : 4 * 600) << "nearly all hits find records";
  }
}

TEST(GiServices, BeyondTheLastBounceThereIsNothing) {
  World world(litBall({0, 0, 0.5f}));
  const ShadeContext hit{RayKind::Diffuse, 1};
  for (const GiMode mode : {GiMode::Gather, GiMode::Reference}) {
    const auto services = world.use({.mode = mode});
    for (const vec3& E : indirectAt(*services, pointsInside(), {}, hit)) EXPECT_EQ(E, vec3(0));
  }
}

TEST(GiServices, MaxdistEndsRays) {
  World world(litBall({0, 0, 0.5f}));
  IndirectQuery query;
  query.samples = 300;
  query.maxDistance = kBallRadius;  // cos(theta) > 1/2 is farther: E = (3/4 missing)
  for (const GiMode mode : {GiMode::Gather, GiMode::Reference}) {
    const auto services = world.use({.mode = mode});
    for (const vec3& E : indirectAt(*services, pointsInside(), query))
      EXPECT_NEAR(E.x, 0.25f * kOneBounce, 0.03f * kOneBounce);
  }
}

TEST(GiServices, TransmissionIsBlockedByTheBallAndNotByTheLightBehindIt) {
  SceneBuilder b;
  b.sphere(0.5f, vec3(1), {0, 0, 4});
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints points(0, 0);
  for (int i = 0; i < 4; ++i) points.set3(kPx, points.add(static_cast<uint32_t>(i)), {i == 1 ? 2 : 0, 0, 2});
  std::vector<float> zero(16, 0), z{4, 4, 1, 1}, light(16, 0.5f), green(16, 0.25f), blue(16, 1);
  const std::vector<uint8_t> active{1, 1, 1, 0};
  const TmConstVec3 toward{zero.data(), zero.data(), z.data()};
  const TmVec3 out{light.data(), green.data(), blue.data()};
  services->transmission(points, active.data(), toward, {}, {}, out);
  EXPECT_EQ(light[0], 0);     // behind the ball
  EXPECT_EQ(light[1], 0.5f);  // beside it
  EXPECT_EQ(light[2], 0.5f);  // before it
  light[2] = 0.5f;
  services->transmission(points, active.data(), toward, {.solar = true}, {}, out);
  EXPECT_EQ(light[2], 0);  // solar: the ray has no end
  EXPECT_EQ(light[3], 0.5f);
  EXPECT_EQ(green[1], 0.25f);
  EXPECT_EQ(world.stats.rays.transmission, 5);
}

}  // namespace
}  // namespace tomales
