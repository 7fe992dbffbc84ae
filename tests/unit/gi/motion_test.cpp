// Shadows and gathered light of things that move, against closed forms.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "reyes/base/rng.h"
#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;

mat4 moved(const vec3& t) {
  mat4 m(1.0f);
  m[3] = vec4(t, 1);
  return m;
}

void sampleMotion(Scene& scene) {
  scene.options.shutterClose = 1;
  for (Object& o : scene.objects) {
    auto copy = std::make_shared<Attributes>(*o.attributes);
    copy->trace.sampleMotion = true;
    o.attributes = copy;
  }
}

/// Share of the light from P + toward that arrives, over the whole shutter.
float light(const GiServices& services, const ShadePoints& points, int i, const vec3& toward,
            const ShadowRays& rays = {}) {
  std::vector<uint8_t> active(static_cast<size_t>(points.count()), 0);
  active[static_cast<size_t>(i)] = 1;
  const auto n = active.size();
  std::vector<float> t[3], out[3];
  for (int c = 0; c < 3; ++c) {
    t[c].assign(n, toward[c]);
    out[c].assign(n, 1);
  }
  services.transmission(points, active.data(), {t[0].data(), t[1].data(), t[2].data()}, rays, {},
                        {out[0].data(), out[1].data(), out[2].data()});
  return out[0][static_cast<size_t>(i)];
}

int addPoint(ShadePoints& points, const vec3& P, const vec3& N, const vec3& drift = vec3(0)) {
  const int i = points.add(static_cast<uint32_t>(points.count()) * 7919u + 1);
  points.set3(kPx, i, P);
  points.set3(kNx, i, N);
  points.set3(kNgx, i, N);
  points.set3(kIx, i, -N);
  points.set3(kDriftX, i, drift);
  points.channel(kTime)[i] = -1;
  return i;
}

TEST(MotionInShadows, TheShadowOfAMovingEdgeIsALinearRamp) {
  SceneBuilder b;
  b.quad({-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}, vec3(1));
  b.quad({-8, 1, -5}, {0, 1, -5}, {0, 1, 5}, {-8, 1, 5}, vec3(1));
  b.scene.objects[1].worldFromObject = {{0, 1}, {moved({-1, 0, 0}), moved({1, 0, 0})}};
  sampleMotion(b.scene);
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints points(0, 0);
  for (int i = 0; i < 400; ++i) addPoint(points, {-3 + 6 * static_cast<float>(i) / 399, 0, 0}, {0, 1, 0});
  double worst = 0, bias = 0;
  for (int i = 0; i < 400; ++i) {
    const float x = points.position(i).x;
    // Light at (0, 2, 0): the way to it passes the height of the edge at x / 2, and the edge is there at (x/2 + 1) / 2.
    const float lit = std::clamp((x / 2 + 1) / 2, 0.0f, 1.0f);
    const float is = light(*services, points, i, vec3(0, 2, 0) - points.position(i));
    worst = std::max(worst, double{std::abs(is - lit)});
    bias += (is - lit) / 400;
  }
  EXPECT_LT(worst, 1.0 / 16 + 1e-3) << "sixteen strata of the shutter";
  EXPECT_LT(std::abs(bias), 0.002);
}

TEST(MotionInShadows, WhatMovesDoesNotShadowItself) {
  SceneBuilder b;
  b.sphere(1, vec3(1), {0, 0, 0});
  b.scene.objects[0].worldFromObject = {{0, 1}, {moved({0, 0, 5}), glm::rotate(moved({2, 1, 6}), 2.0f, vec3(1, 2, 3))}};
  sampleMotion(b.scene);
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints points(0, 0);
  const vec3 toLight = glm::normalize(vec3(0.3f, 1, -0.2f));
  for (int i = 0; i < 200; ++i) {
    const vec2 xi = sobol2(static_cast<uint32_t>(i), 5);
    const float z = 1 - 2 * xi.x, r = std::sqrt(1 - z * z);
    const vec3 n(r * std::cos(2 * kPi * xi.y), r * std::sin(2 * kPi * xi.y), z);
    addPoint(points, vec3(0, 0, 5) + n, n);
  }
  int checked = 0;
  for (int i = 0; i < 200; ++i) {
    // A point turns with the sphere, so only of a point that faces the light all the time is it known that it is always
    // lit.
    const Motion& m = world.scene.groups[0].currentFromOpen;
    bool always = true;
    for (int k = 0; k <= 8; ++k)
      always &= dot(transformVector(m.at(static_cast<float>(k) / 8), points.get3(kNx, i)), toLight) > 0.2f;
    if (!always) continue;
    ++checked;
    EXPECT_EQ(light(*services, points, i, toLight, {.solar = true}), 1) << i;
  }
  EXPECT_GT(checked, 10);
}

TEST(MotionInShadows, WhatDeformsCarriesItsPointsAlong) {
  SceneBuilder b;
  b.quad({-1, 0, 4}, {-1, 0, 6}, {1, 0, 6}, {1, 0, 4}, vec3(1));
  SceneBuilder end;
  end.quad({-1, 3, 4}, {-1, 3, 6}, {1, 3, 6}, {1, 3, 4}, vec3(1));
  b.scene.objects[0].shapes.push_back(end.scene.objects[0].shapes[0]);
  b.scene.objects[0].shapeTimes = {0, 1};
  b.quad({-1, 2, 4}, {-1, 2, 6}, {1, 2, 6}, {1, 2, 4}, vec3(1));
  sampleMotion(b.scene);
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints points(0, 0);
  double lit = 0;
  for (int i = 0; i < 64; ++i) addPoint(points, {0, 0, 5}, {0, 1, 0}, {0, 3, 0});
  for (int i = 0; i < 64; ++i) lit += light(*services, points, i, {0, 1, 0}, {.solar = true}) / 64;
  EXPECT_NEAR(lit, 1.0 / 3, 0.01) << "it passes through the lid after two thirds of the shutter";
}

TEST(MotionInGathering, AWallThatIsThereForPartOfTheShutterBringsThatShareOfLight) {
  // A floor under a sky of nothing; a glowing lid (constant 1) covers all of the sky until it leaves.
  SceneBuilder b;
  b.light("indirectlight", {});
  b.quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, vec3(1));
  b.quad({-4000, 1, -4000}, {4000, 1, -4000}, {4000, 1, 4000}, {-4000, 1, 4000}, vec3(1));
  b.scene.objects[1].worldFromObject = {{0, 0.25f, 0.5f}, {mat4(1), mat4(1), moved({0, -5, 0})}};
  sampleMotion(b.scene);
  auto glowing = std::make_shared<Attributes>(*b.scene.objects[1].attributes);
  glowing->surface = std::make_shared<ShaderCall>(call("constant"));
  b.scene.objects[1].attributes = glowing;
  World world(b.scene);
  ShadePoints points(0, 0);
  addPoint(points, {0, 0, 0}, {0, 1, 0});
  IndirectQuery query;
  query.samples = 1024;
  for (const GiMode mode : {GiMode::Gather, GiMode::Reference}) {
    const auto services = world.use({.mode = mode});
    // Its height falls from 1 at 1/4 to -4 at 1/2.
    EXPECT_NEAR(indirectAt(*services, points, query)[0].x, 0.3f, 0.005f);
  }
}

}  // namespace
}  // namespace tomales
