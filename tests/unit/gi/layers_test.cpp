// Rays through what is transparent.
#include "gi/gather/layers.h"

#include <gtest/gtest.h>

#include "tests/unit/gi/fixture.h"

namespace tomales::test {
namespace {

TEST(RayLayers, ARayBehindATransparentSurfaceIsAsWideAsItWasThere) {
  SceneBuilder b;
  b.quad({-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}, vec3(1));
  auto clear = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  clear->opacity = vec3(0);
  b.scene.objects[0].attributes = clear;
  World world(std::move(b.scene));
  RayLayers layers;
  Ray ray{vec3(0), {0, 0, 1}};
  ray.spread = 0.1f;
  ray.radius = 0.05f;
  layers.add(0, ray, {});
  std::vector<Hit> hits;
  layers.meet(world.rays, kMaskSpecular, hits);
  HitAnswers answers;
  answers.color = answers.opacity = {vec3(0)};
  layers.goOn(world.rays, hits, answers, 0.99f, [](int, const vec3&, const vec3&) {});
  ASSERT_EQ(layers.rays.size(), 1u);
  EXPECT_FLOAT_EQ(layers.rays[0].radius, 0.05f + 0.1f * 2);
  EXPECT_FLOAT_EQ(layers.rays[0].origin.z, 2);
}

}  // namespace
}  // namespace tomales::test
