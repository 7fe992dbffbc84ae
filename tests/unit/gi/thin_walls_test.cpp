#include "gi/atlas/thin_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/gi/fixture.h"

namespace tomales::test {
namespace {

/// A wall of 10 cm across the floor, closed below as boxes are: its underside lies on the floor.
Scene floorAndSolidWall(bool wallFirst) {
  SceneBuilder b;
  const auto floor = [&] { b.quad({-3, 0, 1}, {-3, 0, 5}, {3, 0, 5}, {3, 0, 1}, vec3(0.7f)); };
  const auto wall = [&] {
    const float x = 0.05f;
    for (const float side : {-x, x}) b.quad({side, 0, 1}, {side, 1, 1}, {side, 1, 5}, {side, 0, 5}, vec3(0.5f));
    b.quad({-x, 0, 1}, {x, 0, 1}, {x, 0, 5}, {-x, 0, 5}, vec3(0.5f));
  };
  if (wallFirst) wall();
  floor();
  if (!wallFirst) wall();
  return std::move(b.scene);
}

TEST(ThinWalls, ASolidWallStandsOnTheFloorThatGoesOnBehindIt) {
  constexpr float kReach = 0.26f, kFromWall = 0.13f;
  for (const bool wallFirst : {false, true}) {
    const World world(floorAndSolidWall(wallFirst));
    const SightAlongSurface sight = sightAlongSurfaces(world.rays);
    const SightLines lines = sight({0.05f + kFromWall, 0, 3}, {0, 1, 0}, kReach);
    EXPECT_NEAR(*std::ranges::min_element(lines), kFromWall, 1e-3f) << wallFirst;
    EXPECT_EQ(*std::ranges::max_element(lines), kReach);
  }
}

TEST(ThinWalls, AWallBehindWhichNothingIsPartsNoLight) {
  SceneBuilder b;
  b.quad({0.05f, 0, 1}, {0.05f, 0, 5}, {3, 0, 5}, {3, 0, 1}, vec3(0.7f));
  b.quad({0.05f, 0, 1}, {0.05f, 1, 1}, {0.05f, 1, 5}, {0.05f, 0, 5}, vec3(0.5f));
  const World world(std::move(b.scene));
  const SightLines lines = sightAlongSurfaces(world.rays)({0.18f, 0, 3}, {0, 1, 0}, 0.26f);
  EXPECT_EQ(*std::ranges::min_element(lines), 0.26f);
}

}  // namespace
}  // namespace tomales::test
