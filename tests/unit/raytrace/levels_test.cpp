// Surfaces that rays see at several levels, and the cache that holds them.
#include <gtest/gtest.h>

#include "raytrace/ray_scene.h"
#include "raytrace/resident_cache.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"
#include "tests/unit/directions.h"
#include "world.h"

namespace tomales::test {
namespace {

struct LevelledWorld : World {
  explicit LevelledWorld(TessellationMode mode, size_t cacheBytes = 1 << 30, bool displaced = true) {
    attributes.trace.rate = mode;
    attributes.shadingRate = 4;
    attributes.trace.displacements = displaced;
    attributes.displacementBound = 0.1f;
    if (displaced)
      attributes.displacement =
          shader("noisybump", {floatsParam("Km", ValueType::Float, Storage::Uniform, {0.05f}),
                               floatsParam("frequency", ValueType::Float, Storage::Uniform, {3})});
    add(sphere(), translation({0, 0, 4}));
    RaySettings settings;
    settings.geometryCacheBytes = cacheBytes;
    build(settings);
  }
};

TEST(Levels, ARayFromWithinAClosedSurfaceMeetsItAtAnyLevel) {
  const LevelledWorld world(TessellationMode::Multiresolution);
  for (const TessellationLevel level : {TessellationLevel::Fine, TessellationLevel::Medium, TessellationLevel::Coarse})
    for (uint32_t i = 0; i < 20000; ++i) {
      Ray ray{{0.1f, -0.05f, 4.02f}, anyDirection(i)};
      ray.level = level;
      const Hit hit = world.rays->closest(ray, kMaskDiffuse);
      ASSERT_EQ(hit.object, 0);
      EXPECT_NEAR(hit.t, 1, 0.25f);
      EXPECT_GT(dot(hit.geometricNormal, ray.direction), 0) << "it leaves";
      EXPECT_GT(dot(hit.normal, hit.geometricNormal), 0.5f);
    }
}

TEST(Levels, WideRaysMeetCoarsePolygonsAndNarrowOnesFine) {
  const LevelledWorld world(TessellationMode::Multiresolution, 1 << 30, false);
  double off[3] = {0, 0, 0};
  for (const TessellationLevel level : {TessellationLevel::Fine, TessellationLevel::Medium, TessellationLevel::Coarse})
    for (uint32_t i = 0; i < 5000; ++i) {
      Ray ray{{0, 0, 4}, anyDirection(i)};
      ray.level = level;
      off[static_cast<size_t>(level)] =
          std::max(off[static_cast<size_t>(level)], std::abs(1.0 - double{world.rays->closest(ray, kMaskDiffuse).t}));
    }
  EXPECT_LT(4 * off[0], off[1]);
  EXPECT_LT(2 * off[1], off[2]);
  Ray ray{{0, 0, 4}, {0, 0, 1}};
  world.rays->prepareOrigin(0, ray.origin, 0, ray);
  EXPECT_EQ(ray.level, TessellationLevel::Fine);
  ray.spread = 0.04f;
  world.rays->prepareOrigin(0, ray.origin, 0, ray);
  EXPECT_EQ(ray.level, TessellationLevel::Coarse);
  EXPECT_GT(ray.offset, off[2]) << "the offset is that of the level that the ray meets";
}

TEST(Levels, WhatLeavesAHitSeesNoFinerLevel) {
  LevelledWorld world(TessellationMode::Multiresolution, 1 << 30, false);
  const RayScene::Impl rays(world.scene, *world.camera, *world.shading, {}, world.log);
  for (const TessellationLevel met : {TessellationLevel::Fine, TessellationLevel::Medium, TessellationLevel::Coarse})
    for (uint32_t i = 0; i < 100; ++i) {
      const vec3 P = vec3(0, 0, 4) + anyDirection(i);
      Ray ray{P, {0, 0, 1}};
      ray.radius = rays.leastRadius(0, met, P);
      EXPECT_EQ(rays.levelOf(ray, P), met);
    }
}

TEST(Levels, PatchParametersLeadBackToTheHit) {
  const LevelledWorld world(TessellationMode::Full, 1 << 30, false);
  for (uint32_t i = 0; i < 5000; ++i) {
    const Ray ray{{0, 0, 4}, anyDirection(i)};
    const Hit hit = world.rays->closest(ray, kMaskDiffuse);
    ASSERT_EQ(hit.object, 0);
    const float u = hit.u, v = hit.v;
    float P[3] = {0, 0, 0}, rest[9];
    world.scene.objects[0].shape().evaluate(
        hit.patch, 1, &u, &v,
        {P, P + 1, P + 2, rest, rest + 1, rest + 2, rest + 3, rest + 4, rest + 5, rest + 6, rest + 7, rest + 8});
    EXPECT_LT(glm::length(vec3(P[0], P[1], P[2]) - ray.direction * hit.t), 5e-3f);
    EXPECT_GT(dot(hit.normal, glm::normalize(vec3(P[0], P[1], P[2]))), 0.9999f);
  }
}

std::vector<Hit> hitsOf(const World& world, int threads) {
  const ThreadLimit limit(threads);
  std::vector<Hit> hits(900);
  parallelFor(hits.size(), 16, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      Ray ray{{0.1f, -0.05f, 4.02f}, anyDirection(static_cast<uint32_t>(i))};
      ray.level = static_cast<TessellationLevel>(i % 3);
      ray.offset = i % 2 ? 1e-3f : 0.0f;
      hits[i] = world.rays->closest(ray, kMaskDiffuse);
    }
  });
  return hits;
}

TEST(GeometryCache, ASmallOneGivesTheSameHitsForAnyNumberOfThreads) {
  LevelledWorld large(TessellationMode::Multiresolution), small(TessellationMode::Multiresolution, 300000);
  const std::vector<Hit> expected = hitsOf(large, 1);
  for (const int threads : {1, 4}) {
    const std::vector<Hit> found = hitsOf(small, threads);
    for (size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].t, expected[i].t);
      ASSERT_EQ(found[i].u, expected[i].u);
      ASSERT_EQ(found[i].v, expected[i].v);
      ASSERT_EQ(found[i].normal, expected[i].normal);
    }
  }
  large.rays->report(large.stats);
  small.rays->report(small.stats);
  EXPECT_GT(small.stats.geometryCache.misses, 4 * large.stats.geometryCache.misses) << "and had to build again";
  EXPECT_LE(small.stats.geometryCache.bytes, 600000);
  EXPECT_GT(large.stats.geometryCache.bytes, 700000);
}

/// A wavy field over -1..1 in x and y, of n x n patches. With `far` the first patch reaches so far that twice its size
/// is no float.
PrimPtr field(int n, bool far) {
  std::vector<float> P;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const float x = 2 * static_cast<float>(i) / static_cast<float>(n) - 1,
                  y = 2 * static_cast<float>(j) / static_cast<float>(n) - 1;
      P.insert(P.end(), {far && i == 0 && j == 0 ? -3e38f : x, y, 0.1f * std::sin(9 * x) * std::cos(7 * y)});
    }
  Problems problems;
  return makeBilinearPatchMesh(n + 1, false, n + 1, false, {floatsParam("P", ValueType::Point, Storage::Vertex, P)},
                               problems);
}

std::vector<Hit> fieldHits(int threads) {
  const ThreadLimit limit(threads);
  World world;
  world.attributes.trace.rate = TessellationMode::Multiresolution;
  world.attributes.shadingRate = 1e4f;  // one polygon a patch: thousands of tiles
  world.attributes.trace.displacements = true;
  world.attributes.displacementBound = 0.1f;
  world.attributes.displacement = shader("noisybump", {floatsParam("Km", ValueType::Float, Storage::Uniform, {0.05f})});
  world.add(field(64, false), translation({0, 0, 3}));
  world.build();
  std::vector<Hit> hits;
  for (int j = 0; j <= 128; ++j)  // through the edges of the patches, which two of them share
    for (int i = 0; i <= 128; ++i) {
      Ray ray{{static_cast<float>(i - 64) / 64.0f, static_cast<float>(j - 64) / 64.0f, 0}, {0, 0, 1}};
      ray.level = TessellationLevel::Coarse;
      hits.push_back(world.rays->closest(ray, kMaskDiffuse));
    }
  return hits;
}

TEST(Levels, ChunksOfManySmallPatchesAreTheSameForAnyNumberOfThreads) {
  const std::vector<Hit> expected = fieldHits(1), found = fieldHits(8);
  for (size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].t, expected[i].t);
    ASSERT_EQ(found[i].patch, expected[i].patch);
    ASSERT_EQ(found[i].u, expected[i].u);
  }
}

TEST(Levels, APatchThatIsNotFiniteIsReportedAndTheOthersAreThere) {
  World world;
  world.attributes.trace.rate = TessellationMode::Multiresolution;
  mat4 twice = 2.0f * mat4(1.0f);
  twice[3] = vec4(0, 0, 3, 1);
  world.add(field(8, true), twice);
  world.build();
  EXPECT_GE(world.log.count("trace-not-finite"), 1);
  for (int i = 0; i < 7; ++i) {
    const vec3 through(-1.24f + 0.5f * static_cast<float>(i), 0.76f, 0);
    EXPECT_EQ(world.rays->closest({through, {0, 0, 1}}, kMaskDiffuse).object, 0) << through.x;
  }
}

TEST(Levels, WhatAsksForTooManyMicropolygonsIsToldTheWayOut) {
  World world;
  world.attributes.trace.rate = TessellationMode::Multiresolution;
  world.attributes.shadingRate = 1e-3f;
  Problems problems;
  const std::vector<float> twisted{-1, -1, 2, 1, -1, 2, -1, 1, 2, 1, 1, 3};
  world.add(makeBilinearPatchMesh(2, false, 2, false, {floatsParam("P", ValueType::Point, Storage::Vertex, twisted)},
                                  problems));
  world.build();
  const auto entries = world.log.entries();
  EXPECT_TRUE(std::any_of(entries.begin(), entries.end(), [](const LogEntry& e) {
    return e.code == "trace-tessellation" && e.message.find("raise ShadingRate") != std::string::npos;
  }));
}

TEST(Levels, AWideOriginSeesCoarsePolygonsToo) {
  const LevelledWorld world(TessellationMode::Multiresolution, 1 << 30, false);
  Ray ray{{0, 0, 4}, {0, 0, 1}};
  ray.radius = 0.2f;
  world.rays->prepareOrigin(0, ray.origin, 0, ray);
  EXPECT_EQ(ray.level, TessellationLevel::Coarse);
}

struct Block {
  int name;
  size_t bytes() const { return 10; }
};

TEST(ResidentCache, KeepsWhatWasUsedLast) {
  ResidentCache<Block> cache(4, 25);
  int made = 0;
  const auto get = [&](size_t i) {
    return cache
        .get(i,
             [&] {
               ++made;
               return std::make_shared<const Block>(Block{static_cast<int>(i)});
             })
        ->name;
  };
  EXPECT_EQ(get(0), 0);
  EXPECT_EQ(get(1), 1);
  EXPECT_EQ(get(0), 0);  // 1 is now the older
  EXPECT_EQ(get(2), 2);
  EXPECT_EQ(made, 3);
  EXPECT_EQ(get(0), 0);
  EXPECT_EQ(made, 3);
  EXPECT_EQ(get(1), 1);
  EXPECT_EQ(made, 4);
  EXPECT_EQ(cache.figures().lookups, 6);
  EXPECT_EQ(cache.figures().misses, 4);
  EXPECT_EQ(cache.figures().mostBytes, 20);
}

TEST(ResidentCache, MakesRoomForMoreThanOne) {
  ResidentCache<Block> cache(32, 160);
  for (size_t i = 0; i < 17; ++i)
    cache.get(i, [&] { return std::make_shared<const Block>(Block{static_cast<int>(i)}); });
  int made = 0;
  const auto holds = [&](size_t i) {
    cache.get(i, [&] {
      ++made;
      return std::make_shared<const Block>(Block{static_cast<int>(i)});
    });
    return made == 0;
  };
  EXPECT_TRUE(holds(16));
  EXPECT_TRUE(holds(3)) << "the fourth oldest";
  EXPECT_FALSE(holds(2));
}

}  // namespace
}  // namespace tomales::test
