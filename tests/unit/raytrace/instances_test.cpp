#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "world.h"

namespace tomales::test {
namespace {

TEST(Instances, AreMetWhereObjectsOfTheirOwnAreAndOnTheSameSide) {
  mat4 turned = translation({-1.5f, 0, 5}), mirrored = translation({1.5f, 0.3f, 6}), squeezed = translation({0, 2, 7});
  turned[0] = {0.8f, 0, 0.6f, 0};
  turned[2] = {-0.6f, 0, 0.8f, 0};
  mirrored[0] = {-1, 0, 0, 0};
  squeezed[0] = {1.5f, 0.2f, 0, 0};
  squeezed[1] = {0, 0.4f, 0.1f, 0};
  World shared, alone;
  const PrimPtr one = waves();
  for (const bool insideOut : {false, true})
    for (mat4 m : {turned, mirrored, squeezed}) {
      if (insideOut) m[3].y -= 2.5f;
      shared.attributes.insideOut = alone.attributes.insideOut = insideOut;
      shared.attributes.trace.tessellation = alone.attributes.trace.tessellation = 8;
      shared.add(one, m);
      alone.add(waves(), m);
    }
  shared.build();
  alone.build();
  EXPECT_LT(shared.stats.raytrace.coarsePolygons, alone.stats.raytrace.coarsePolygons / 2);
  int hits = 0;
  for (uint32_t i = 0; i < 4096; ++i) {
    const vec2 xi = 2.0f * sobol2(i, 3) - 1.0f;
    const vec3 d = glm::normalize(vec3(0.5f * xi.x, 0.5f * xi.y, 1));
    const Hit a = shared.rays->closest({vec3(0), d}, kMaskDiffuse), b = alone.rays->closest({vec3(0), d}, kMaskDiffuse);
    if (a.object != b.object) continue;  // at silhouettes the coarse surfaces may differ
    if (a.object < 0) continue;
    ++hits;
    EXPECT_NEAR(a.t, b.t, 2e-3f);
    EXPECT_GT(dot(a.normal, b.normal), 0.99f);
    EXPECT_GT(dot(a.geometricNormal, b.geometricNormal), 0.97f);
    EXPECT_NEAR(a.u, b.u, 0.02f);
  }
  EXPECT_GT(hits, 1500);
}

TEST(Instances, HitListOffsetsAndOpacityAreThoseOfTheirOwnAttributes) {
  World world;
  const PrimPtr one = waves();
  const int near = world.add(one, translation({0, 0, 5}));
  world.attributes.opacity = vec3(0.25f);
  world.add(one, translation({0, 0, 6}));
  world.attributes.visibility.diffuse = false;
  world.add(one, translation({0, 0, 7}));
  world.build();
  // From the first sheet, its own polygons left behind by the hit list, to the second.
  Ray ray = world.rayFrom(near, {0.1f, 0.1f, 5 + 0.2f * std::sin(0.4f) * std::cos(0.3f)}, {0, 0, 1});
  EXPECT_GT(ray.offset, 0);
  const Hit hit = world.rays->closest(ray, kMaskDiffuse);
  EXPECT_EQ(hit.object, 1);
  EXPECT_NEAR(hit.t, 1, 0.03f);
  EXPECT_NEAR(world.transmission(ray).x, 0.75f * 0.75f, 1e-5f);
  EXPECT_EQ(world.rays->closest({vec3(0, 0, 6.5f), vec3(0, 0, 1)}, kMaskDiffuse).object, -1);
  EXPECT_EQ(world.rays->closest({vec3(0, 0, 6.5f), vec3(0, 0, 1)}, kMaskSpecular).object, 2);
  const Hit through = world.rays->closest({vec3(0.1f, 0.1f, 0), vec3(0, 0, 1)}, kMaskDiffuse);
  EXPECT_EQ(through.object, 0);
}

}  // namespace
}  // namespace tomales::test
