// Rays through what is transparent.
#include "gi/layers.h"

#include <gtest/gtest.h>

#include "../raytrace/world.h"

namespace tomales::test {
namespace {

TEST(RayLayers, ARayBehindATransparentSurfaceIsAsWideAsItWasThere) {
  World world;
  world.attributes.opacity = vec3(0);
  world.add(parallelogram({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}));
  world.build();
  RayLayers layers;
  Ray ray{vec3(0), {0, 0, 1}};
  ray.spread = 0.1f, ray.radius = 0.05f;
  layers.add(0, ray, {});
  std::vector<Hit> hits;
  layers.meet(*world.rays, kMaskSpecular, hits);
  HitAnswers answers;
  answers.color = answers.opacity = {vec3(0)};
  layers.goOn(*world.rays, hits, answers, 0.99f, [](int, const vec3&, const vec3&) {});
  ASSERT_EQ(layers.rays.size(), 1u);
  EXPECT_FLOAT_EQ(layers.rays[0].radius, 0.05f + 0.1f * 2);
  EXPECT_FLOAT_EQ(layers.rays[0].origin.z, 2);
}

}  // namespace
}  // namespace tomales::test
