#include "gi/atlas/sight_lines.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/gi/fixture.h"

namespace tomales::test {
namespace {

/// A wall of 10 cm across the floor, closed below as boxes are: its underside lies on the floor, as near as numbers
/// tell.
Scene floorAndSolidWall() {
  SceneBuilder b;
  b.quad({-3, 0, 1}, {-3, 0, 5}, {3, 0, 5}, {3, 0, 1}, vec3(0.7f));
  const float x = 0.05f, y = 1e-5f;
  for (const float side : {-x, x}) b.quad({side, y, 1}, {side, 1, 1}, {side, 1, 5}, {side, y, 5}, vec3(0.5f));
  b.quad({-x, y, 1}, {x, y, 1}, {x, y, 5}, {-x, y, 5}, vec3(0.5f));
  return std::move(b.scene);
}

TEST(SightLines, ASolidWallStandsOnTheFloorThatGoesOnBehindIt) {
  constexpr float kReach = 0.26f, kFromWall = 0.13f;
  const World world(floorAndSolidWall());
  const SightLines lines = sightAlongSurfaces(world.rays)({0.05f + kFromWall, 0, 3}, {0, 1, 0}, kReach);
  EXPECT_NEAR(*std::ranges::min_element(lines), kFromWall, 1e-3f);
  EXPECT_EQ(*std::ranges::max_element(lines), kReach);
}

TEST(SightLines, AWallBehindWhichNothingIsPartsNoLight) {
  SceneBuilder b;
  b.quad({0.05f, 0, 1}, {0.05f, 0, 5}, {3, 0, 5}, {3, 0, 1}, vec3(0.7f));
  b.quad({0.05f, 0, 1}, {0.05f, 1, 1}, {0.05f, 1, 5}, {0.05f, 0, 5}, vec3(0.5f));
  const World world(std::move(b.scene));
  const SightLines lines = sightAlongSurfaces(world.rays)({0.18f, 0, 3}, {0, 1, 0}, 0.26f);
  EXPECT_EQ(*std::ranges::min_element(lines), 0.26f);
}

}  // namespace
}  // namespace tomales::test
