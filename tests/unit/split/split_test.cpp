#include "reyes/split.h"

#include <gtest/gtest.h>

#include "reyes/base/parallel.h"
#include "reyes/dice.h"
#include "tests/unit/split/test_scene.h"

namespace tomales {
namespace {
using test::sceneOf;
using test::translation;

PrimPtr sphere(float radius = 1) {
  Problems problems;
  return makeSphere(radius, -radius, radius, 360, {}, problems);
}
PrimPtr quad(float size, float y) {
  Problems problems;
  Param P;
  P.name = "P", P.type = ValueType::Point, P.storage = Storage::Vertex;
  P.floats = {-size, y, -size, size, y, -size, -size, y, size, size, y, size};
  return makeBilinearPatchMesh(2, false, 2, false, {P}, problems);
}
std::vector<SubPatch> split(const Scene& scene, Stats& stats) {
  Log log(Log::Verbosity::Quiet);
  const Camera camera(scene.options);
  return splitScene(scene, camera, camera.crop(), stats, log);
}

TEST(Split, PiecesOfAPatchCoverItOnceWhenAllOfItIsInView) {
  const Scene scene = sceneOf({sphere()}, translation({0, 0, 4}));
  Stats stats;
  double covered = 0;
  for (const SubPatch& p : split(scene, stats)) {
    covered += (p.rect.u1 - p.rect.u0) * (p.rect.v1 - p.rect.v0);
    EXPECT_LE(p.nu * p.nv, scene.options.gridSize);
  }
  EXPECT_DOUBLE_EQ(covered, 1.0);
}

TEST(Split, RasterBoundsHoldEveryDicedVertex) {
  const Scene scene = sceneOf({sphere(), quad(3, -0.7f)}, translation({0.4f, 0, 3.5f}));
  const Camera camera(scene.options);
  Stats stats;
  for (const SubPatch& p : split(scene, stats)) {
    const Grid g = dice(scene, p.object, p.patch, p.rect, p.nu, p.nv, 1);
    for (int i = 0; i < g.vertexCount(); ++i) {
      const vec2 r = camera.raster(g.position(0, i));
      EXPECT_TRUE(r.x >= p.raster.lo.x && r.x <= p.raster.hi.x && r.y >= p.raster.lo.y && r.y <= p.raster.hi.y);
      EXPECT_GE(g.P(0, 2)[i], p.zMin - 1e-5f);
    }
  }
}

TEST(Split, MicropolygonsAreNoLargerThanTheShadingRateAsks) {
  for (const float rate : {0.25f, 1.0f, 4.0f}) {
    const Scene scene = sceneOf({sphere()}, translation({0, 0, 4}), rate);
    const Camera camera(scene.options);
    Stats stats;
    for (const SubPatch& p : split(scene, stats)) {
      const Grid g = dice(scene, p.object, p.patch, p.rect, p.nu, p.nv, 1);
      for (int j = 0; j <= g.nv; ++j)
        for (int i = 0; i < g.nu; ++i) {
          const int k = j * (g.nu + 1) + i;
          EXPECT_LT(glm::length(camera.raster(g.position(0, k + 1)) - camera.raster(g.position(0, k))), 1.35f * std::sqrt(rate));
        }
    }
  }
}

TEST(Split, AGroundPlaneThroughTheEyeEndsInFinitelyManyPieces) {
  // The plane runs from far behind the camera to far in front, a little below the eye.
  const Scene scene = sceneOf({quad(1000, -1.0f)}, mat4(1.0f), 1, 64);
  Stats stats;
  const auto pieces = split(scene, stats);
  EXPECT_GT(pieces.size(), 4u);
  EXPECT_LT(pieces.size(), 4000u);
  EXPECT_EQ(stats.geometry.eyeSplitsGivenUp, 0);
}

TEST(Split, WhatLiesBehindTheEyeOrOutsideTheWindowIsCulled) {
  Stats stats;
  EXPECT_TRUE(split(sceneOf({sphere()}, translation({0, 0, -4})), stats).empty());
  EXPECT_TRUE(split(sceneOf({sphere()}, translation({20, 0, 4})), stats).empty());
}

TEST(Split, DoesNotDependOnThreadsOrCrop) {
  Scene scene = sceneOf({sphere(), quad(3, -0.7f), sphere(0.3f)}, translation({0, 0, 4}));
  Stats stats;
  const auto whole = split(scene, stats);
  {
    const ThreadLimit one(1);
    const auto again = split(scene, stats);
    ASSERT_EQ(whole.size(), again.size());
    for (size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(whole[i].rect.u0, again[i].rect.u0);
  }
  scene.options.cropWindow = {0.4f, 0.6f, 0.4f, 0.6f};
  const auto cropped = split(scene, stats);
  EXPECT_LT(cropped.size(), whole.size());
  for (const SubPatch& c : cropped)
    EXPECT_TRUE(std::any_of(whole.begin(), whole.end(), [&](const SubPatch& w) {
      return w.object == c.object && w.rect.u0 == c.rect.u0 && w.rect.u1 == c.rect.u1 && w.rect.v0 == c.rect.v0 && w.nu == c.nu && w.nv == c.nv;
    }));
}

}  // namespace
}  // namespace tomales
