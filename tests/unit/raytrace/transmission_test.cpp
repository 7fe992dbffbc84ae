#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "world.h"

namespace tomales::test {
namespace {

TEST(Transmission, IsTheProductOfTheSheetsOnTheWay) {
  World world;
  const vec3 opacities[3] = {{0.5f, 0.2f, 0}, {0.25f, 0.5f, 1}, {0.1f, 0, 0.5f}};
  vec3 product(1);
  for (int i = 0; i < 3; ++i) {
    world.attributes.opacity = opacities[i];
    world.add(parallelogram({-1, -1, 2.0f + static_cast<float>(i)}, {2, 0, 0}, {0, 2, 0}));
    product *= 1.0f - opacities[i];
  }
  world.build();
  // (0, 0) lies on the diagonal of every quad: both triangles report it.
  for (const vec2 at : {vec2(0.3f, -0.2f), vec2(0), vec2(0.25f, -0.25f)}) {
    const vec3 clear = world.transmission({vec3(at, 0), vec3(0, 0, 1)});
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(clear[c], product[c]);
  }
  EXPECT_EQ(world.transmission({vec3(0.3f, 0.1f, 0), vec3(0, 0, 1), 2.5f}), 1.0f - opacities[0]);
}

TEST(Transmission, AnOpaqueSheetStopsTheRayUnlessItIsTheOneThatTheRayLeaves) {
  World world;
  world.attributes.trace.offset = 0.1f;
  world.add(parallelogram({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}));
  world.add(parallelogram({-1, -1, 2.05f}, {0.5f, 0, 0}, {0, 2, 0}));
  world.build();
  EXPECT_EQ(world.transmission({vec3(0), vec3(0, 0, 1)}), vec3(0));
  EXPECT_EQ(world.transmission(world.rayFrom(0, {0.5f, 0, 1.99f}, {0, 0, 1})), vec3(1));
  EXPECT_EQ(world.transmission(world.rayFrom(0, {-0.8f, 0, 1.99f}, {0, 0, 1})), vec3(0)) << "a second sheet near by";
}

TEST(Transmission, TheSurfaceOfALightDoesNotShadowItself) {
  World world;
  world.add(parallelogram({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}));
  world.build();
  for (uint32_t i = 0; i < 1000; ++i) {
    const vec2 xi = sobol2(i, 1);
    const vec3 toward(2 * xi.x - 1, 2 * xi.y - 1, 2);
    EXPECT_EQ(world.transmission({vec3(0), glm::normalize(toward), glm::length(toward)}), vec3(1));
  }
}

}  // namespace
}  // namespace tomales::test
