#include <gtest/gtest.h>

#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"
#include "tests/unit/directions.h"
#include "world.h"

namespace tomales::test {
namespace {

TEST(Closest, MeetsTheWallsOfABoxWhereTheyAre) {
  World world;
  const vec3 lo(-1, -2, 3), hi(2, 1, 6), eye(0.5f, -0.3f, 4);
  world.addRoom(lo, hi);
  world.build();
  EXPECT_EQ(world.stats.raytrace.coarsePolygons, 6);
  for (uint32_t i = 0; i < 4096; ++i) {
    const vec3 d = anyDirection(i);
    const vec3 walls = glm::mix(lo, hi, glm::greaterThan(d, vec3(0)));
    const vec3 distances = (walls - eye) / d;
    const Hit hit = world.rays->closest({eye, d}, kMaskDiffuse);
    ASSERT_GE(hit.object, 0);
    EXPECT_NEAR(hit.t, std::min({distances.x, distances.y, distances.z}), 2e-5f);
    EXPECT_LT(dot(hit.geometricNormal, d), 0) << "walls face inwards";
  }
}

TEST(Closest, MeetsASphereToWithinTheDeviationOfItsPolygons) {
  World world;
  world.attributes.trace.tessellation = 4;
  world.add(sphere(), translation({0, 0, 5}));
  world.build();
  int hits = 0;
  for (uint32_t i = 0; i < 4096; ++i) {
    const vec2 xi = 2.0f * sobol2(i, 3) - 1.0f;
    const vec3 d = glm::normalize(vec3(0.19f * xi.x, 0.19f * xi.y, 1)), c(0, 0, 5);
    const float b = dot(d, c), disc = b * b - 24;
    const Hit hit = world.rays->closest({vec3(0), d}, kMaskSpecular);
    if (disc < 0.05f) continue;
    ASSERT_EQ(hit.object, 0);
    ++hits;
    EXPECT_NEAR(hit.t, b - std::sqrt(disc), 0.01f);
    const vec3 normal = glm::normalize(d * hit.t - c);
    EXPECT_GT(dot(hit.normal, normal), 0.9999f);
    EXPECT_NEAR(glm::length(hit.normal), 1, 1e-5f);
    EXPECT_GT(dot(hit.geometricNormal, normal), 0.99f);
  }
  EXPECT_GT(hits, 1000);
}

TEST(Closest, PatchParametersLeadBackToTheHit) {
  World world;
  world.add(sphere(), translation({0, 0, 5}));
  world.build();
  for (uint32_t i = 0; i < 500; ++i) {
    const vec2 xi = 2.0f * sobol2(i, 3) - 1.0f;
    const Ray ray{vec3(0), glm::normalize(vec3(0.1f * xi.x, 0.1f * xi.y, 1))};
    const Hit hit = world.rays->closest(ray, kMaskDiffuse);
    float p[12];
    world.scene.objects[0].shape().evaluate(
        hit.patch, 1, &hit.u, &hit.v,
        {p, p + 1, p + 2, p + 3, p + 4, p + 5, p + 6, p + 7, p + 8, p + 9, p + 10, p + 11});
    EXPECT_LT(glm::length(vec3(p[0], p[1], p[2] + 5) - ray.direction * hit.t), 0.03f);
  }
}

TEST(Closest, NormalsTurnWithOrientation) {
  World world;
  world.attributes.insideOut = true;
  world.add(sphere(), translation({0, 0, 5}));
  world.build();
  const Hit hit = world.rays->closest({vec3(0), vec3(0, 0, 1)}, kMaskDiffuse);
  EXPECT_GT(hit.normal.z, 0.99f);
  EXPECT_GT(hit.geometricNormal.z, 0.9f);
}

TEST(Closest, EndsBeforeTMax) {
  World world;
  world.add(parallelogram({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}));
  world.build();
  for (const float offset : {0.0f, 0.1f, 5.0f}) {
    Ray ray{vec3(0.1f, 0.2f, 0), vec3(0, 0, 1), 1.999f};
    ray.offset = offset;
    // An offset that reaches the sheet makes it the origin: nothing follows.
    EXPECT_EQ(world.rays->closest(ray, kMaskDiffuse).object, -1);
    ray.tMax = 2.001f;
    EXPECT_EQ(world.rays->closest(ray, kMaskDiffuse).object, offset > 2 ? -1 : 0);
  }
}

TEST(Closest, OnlyRaysOfTheRightKindSeeAnObject) {
  World world;
  world.attributes.visibility = {true, false, true, false, true};
  world.attributes.opacity = vec3(1);
  world.add(parallelogram({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}));
  world.build();
  const Ray ray{vec3(0.1f, 0.2f, 0), vec3(0, 0, 1)};
  EXPECT_EQ(world.rays->closest(ray, kMaskDiffuse).object, -1);
  EXPECT_EQ(world.rays->closest(ray, kMaskSpecular).object, 0);
  EXPECT_EQ(world.rays->closest(ray, kMaskPhoton).object, 0);
  EXPECT_EQ(world.transmission(ray), vec3(1));
}

TEST(Closest, AnObjectThatNoRaySeesIsNotTessellated) {
  World world;
  world.attributes.visibility = {true, false, false, false, false};
  world.add(sphere(), translation({0, 0, 5}));
  world.build();
  EXPECT_EQ(world.stats.raytrace.coarsePolygons, 0);
}

TEST(Closest, AnEmptySceneIsAllMisses) {
  World world;
  world.build();
  EXPECT_EQ(world.rays->closest({vec3(0), vec3(0, 0, 1)}, kMaskDiffuse).object, -1);
  EXPECT_EQ(world.transmission({vec3(0), vec3(0, 0, 1)}), vec3(1));
}

TEST(Closest, RaysThatAreNoRaysMiss) {
  World world;
  world.addRoom(vec3(-1), vec3(1));
  world.build();
  const float nan = std::nanf("");
  const std::vector<Ray> rays{{vec3(nan), vec3(0, 0, 1)},
                              {vec3(0), vec3(0, nan, 1)},
                              {vec3(0), vec3(0)},
                              {vec3(kInfinity, 0, 0), vec3(0, 0, 1)},
                              {vec3(0), vec3(0, 0, 1), nan},
                              {vec3(0), vec3(0, 0, 1), -1}};
  for (Ray ray : rays)
    for (const float offset : {0.0f, 0.01f, nan}) {
      ray.offset = offset;
      EXPECT_EQ(world.rays->closest(ray, kMaskDiffuse).object, -1);
      EXPECT_EQ(world.transmission(ray), vec3(1));
    }
}

TEST(Closest, PolygonsWithoutAreaAreHarmless) {
  World world;
  world.add(parallelogram({0, 0, 2}, {0, 0, 0}, {0, 0, 0}));
  world.add(parallelogram({-1, -1, 3}, {2, 0, 0}, {0, 2, 0}));
  world.build();
  const Hit hit = world.rays->closest({vec3(0), vec3(0, 0, 1)}, kMaskDiffuse);
  EXPECT_EQ(hit.object, 1);
}

// Rays at shared edges and corners, where two polygons answer at the same t.
std::vector<Hit> hitsWithThreads(int threads) {
  const ThreadLimit limit(threads);
  World world;
  world.attributes.trace.tessellation = 6;
  world.add(sphere(), translation({0, 0, 5}));
  world.add(sphere(0.7f), translation({0.8f, 0.8f, 4}));
  world.build();
  std::vector<Hit> hits(20000);
  parallelFor(hits.size(), 64, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const vec2 xi = glm::floor(sobol2(static_cast<uint32_t>(i), 9) * 24.0f);
      const float phi = 2 * kPi * xi.x / 24, z = 2 * xi.y / 24 - 1, r = std::sqrt(1 - z * z);
      Ray ray{vec3(0), glm::normalize(vec3(r * std::cos(phi), r * std::sin(phi), 5 + z))};
      ray.offset = i % 2 ? 1e-3f : 0.0f;
      hits[i] = world.rays->closest(ray, kMaskDiffuse);
    }
  });
  return hits;
}

TEST(Closest, GivesTheSameBitsForAnyNumberOfThreads) {
  const std::vector<Hit> one = hitsWithThreads(1), two = hitsWithThreads(2);
  for (size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].t, two[i].t);
    ASSERT_EQ(one[i].object, two[i].object);
    ASSERT_EQ(one[i].u, two[i].u);
    ASSERT_EQ(one[i].v, two[i].v);
    ASSERT_EQ(one[i].geometricNormal, two[i].geometricNormal);
  }
}

TEST(RayGeometry, TwoLargeGroupsTakeTwiceTheMemoryOfOne) {
  const auto bytesOf = [](int spheres) {
    World world;
    world.attributes.trace.tessellation = 8;
    for (int i = 0; i < spheres; ++i) {
      world.attributes.shadingRate = 1 + 0.01f * static_cast<float>(i);  // a group of its own
      world.add(sphere(), translation({0, 0, 5 + 3 * static_cast<float>(i)}));
    }
    world.build();
    EXPECT_GT(world.stats.raytrace.coarsePolygons, 4096 * spheres);
    return static_cast<double>(world.stats.raytrace.bytes) / static_cast<double>(world.stats.raytrace.coarsePolygons);
  };
  EXPECT_LT(bytesOf(2), 1.05 * bytesOf(1)) << "positions and indices are copied";
}

}  // namespace
}  // namespace tomales::test
