#include "raytrace/sky_openings.h"

#include <gtest/gtest.h>

#include "world.h"

namespace tomales {
namespace {

/// A room of 4 x 3 x 5 around the eye, open in the wall before it.
struct Room : test::World {
  Room() { attributes.surface = test::shader("matte"); }
  /// The wall at z = 4, but for a hole.
  void addWallAround(const vec2& low, const vec2& high) {
    const auto piece = [&](float x, float X, float y, float Y) {
      if (X > x && Y > y) add(test::parallelogram({x, y, 4}, {X - x, 0, 0}, {0, Y - y, 0}));
    };
    piece(-2, 2, -1.5f, low.y);
    piece(-2, 2, high.y, 1.5f);
    piece(-2, low.x, low.y, high.y);
    piece(high.x, 2, low.y, high.y);
  }
  void addOtherWalls() {
    const vec3 lo(-2, -1.5f, -1), x(4, 0, 0), y(0, 3, 0), z(0, 0, 5);
    add(test::parallelogram(lo, x, y));
    add(test::parallelogram(lo, y, z));
    add(test::parallelogram(lo + x, z, y));
    add(test::parallelogram(lo, z, x));
    add(test::parallelogram(lo + y, x, z));
  }
  std::vector<SkyOpening> find() {
    build();
    return skyOpenings(*rays, *camera, *shading);
  }
};

void expectIs(const SkyOpening& opening, const vec3& center, const vec2& size) {
  EXPECT_NEAR(glm::length(opening.center - center), 0, 0.05f);
  const float u = 2 * glm::length(opening.halfU), v = 2 * glm::length(opening.halfV);
  EXPECT_NEAR(std::max(u, v), std::max(size.x, size.y), 0.06f);
  EXPECT_NEAR(std::min(u, v), std::min(size.x, size.y), 0.06f);
  EXPECT_GT(std::abs(opening.normal().z), 0.99f);
}

TEST(SkyOpenings, AWindowIsFoundWhereItIs) {
  Room room;
  room.addOtherWalls();
  room.addWallAround({0.2f, -0.4f}, {1.4f, 0.3f});
  const std::vector<SkyOpening> found = room.find();
  ASSERT_EQ(found.size(), 1u);
  expectIs(found[0], {0.8f, -0.05f, 4}, {1.2f, 0.7f});
}

TEST(SkyOpenings, TwoWindowsAreTwo) {
  Room room;
  room.addOtherWalls();
  room.addWallAround({-1.5f, -1}, {1.5f, 1});
  room.add(test::parallelogram({-0.5f, -1, 4}, {1, 0, 0}, {0, 2, 0}));
  const std::vector<SkyOpening> found = room.find();
  ASSERT_EQ(found.size(), 2u);
  const int left = found[0].center.x < 0 ? 0 : 1;
  expectIs(found[static_cast<size_t>(left)], {-1, 0, 4}, {1, 2});
  expectIs(found[static_cast<size_t>(1 - left)], {1, 0, 4}, {1, 2});
}

TEST(SkyOpenings, APaneHidesNoSky) {
  Room room;
  room.addOtherWalls();
  room.addWallAround({-0.5f, -0.5f}, {0.5f, 0.5f});
  room.attributes.opacity = vec3(0.2f);
  room.add(test::parallelogram({-0.5f, -0.5f, 3.99f}, {1, 0, 0}, {0, 1, 0}));
  EXPECT_EQ(room.find().size(), 1u);
}

TEST(SkyOpenings, AClosedRoomHasNone) {
  Room room;
  room.addOtherWalls();
  room.addWallAround({0, 0}, {0, 0});
  EXPECT_TRUE(room.find().empty());
}

TEST(SkyOpenings, AnOpenSceneHasNone) {
  Room room;
  room.add(test::parallelogram({-9, -1.5f, -9}, {0, 0, 30}, {18, 0, 0}));
  room.add(test::parallelogram({-1, -1.5f, 4}, {2, 0, 0}, {0, 2, 0}));
  EXPECT_TRUE(room.find().empty());
}

TEST(SkyOpenings, ARoomThatIsSeenFromOutsideHasNone) {
  Room room;
  room.addOtherWalls();
  room.addWallAround({-1, -1}, {1, 1});
  room.add(test::parallelogram({-90, -1.6f, -90}, {0, 0, 180}, {180, 0, 0}));
  mat4 turned = test::translation({0, 0, 9});  // the eye is before the window
  turned[0][0] = turned[2][2] = -1;
  for (Object& o : room.scene.objects) o.worldFromObject = Motion::still(turned);
  EXPECT_TRUE(room.find().empty());
}

TEST(SkyOpenings, TheCropDoesNotMatter) {
  const auto found = [](const std::array<float, 4>& crop) {
    Room room;
    room.addOtherWalls();
    room.addWallAround({0.2f, -0.4f}, {1.4f, 0.3f});
    room.scene.options.cropWindow = crop;
    return room.find();
  };
  const auto whole = found({0, 1, 0, 1}), part = found({0.1f, 0.2f, 0.5f, 0.9f});
  ASSERT_EQ(whole.size(), 1u);
  ASSERT_EQ(part.size(), 1u);
  EXPECT_EQ(whole[0].center, part[0].center);
  EXPECT_EQ(whole[0].halfU, part[0].halfU);
}

}  // namespace
}  // namespace tomales
