#include "reyes/hide/blur_bounds.h"

#include <gtest/gtest.h>

#include "tests/unit/hide/fixture.h"

namespace tomales::test {
namespace {

constexpr int kCells = 8;

/// A square lattice of cells of one pixel, turned, that moves and turns on by `turn`.
std::shared_ptr<const RasterGrid> turned(World& world, float angle, float turn) {
  world.add();
  world.freeze();
  world.scene.objects[0].keyTimes = {0, 1};
  const Surface surface = [=](float u, float v, int key) {
    const float a = angle + turn * static_cast<float>(key), c = std::cos(a), s = std::sin(a);
    const float x = kCells * (u - 0.5f), y = kCells * (v - 0.5f);
    return at(20.3f + 9 * static_cast<float>(key) + c * x - s * y, 30.7f - 5 * static_cast<float>(key) + s * x + c * y);
  };
  return project(makeGrid(0, 1, kCells, kCells, surface, 2), world.scene, Camera(world.scene.options), true);
}

/// The area of a box in square pixels.
float areaOf(const BlurBounds& b, const BlurBox& box) {
  const vec2 s = b.segments[0].slant;
  return 4 * box.xReach * box.yReach / (1 - s.x * s.y);
}

TEST(BlurBounds, BoxesOfATurnedGridAreHardlyLargerThanItsCells) {
  for (int degrees = -180; degrees <= 180; degrees += 15) {
    World world;
    const auto r = turned(world, glm::radians(static_cast<float>(degrees)), 0);
    for (const BlurBounds::Level& level : r->blur->levels) {
      // Along rows and columns it would be twice the area at 45 degrees.
      const float cells = static_cast<float>(kCells / level.columns), most = (cells + 0.11f) * (cells + 0.11f);
      for (int k = 0; k < level.columns * level.rows; ++k)
        EXPECT_LT(areaOf(*r->blur, r->blur->box(0, level, k % level.columns, k / level.columns)), most) << degrees;
    }
  }
}

TEST(BlurBounds, EveryVertexIsInTheBoxesOfItsCellsAtEveryTime) {
  for (const float turn : {0.0f, 0.5f, 3.0f})
    for (int degrees = 0; degrees < 360; degrees += 9) {
      World world;
      const auto r = turned(world, glm::radians(static_cast<float>(degrees)), turn);
      const BlurBounds& b = *r->blur;
      const vec2 slant = b.segments[0].slant;
      const int row = kCells + 1;
      for (size_t l = 0; l < b.levels.size(); ++l)
        for (int j = 0; j < kCells; ++j)
          for (int i = 0; i < kCells; ++i) {
            const BlurBox& box = b.box(0, b.levels[l], i >> l, j >> l);
            for (const int corner : {0, 1, row, row + 1})
              for (const float t : {0.0f, 0.3f, 1.0f}) {
                const auto v = static_cast<size_t>(j * row + i + corner),
                           w = v + static_cast<size_t>(r->grid->stride());
                const vec2 from = glm::mix(vec2(r->x[v], r->y[v]), vec2(r->x[w], r->y[w]), t) -
                                  vec2(box.x + t * box.xStep, box.y + t * box.yStep);
                ASSERT_LT(std::abs(from.x + slant.x * from.y), box.xReach) << degrees << ' ' << turn << ' ' << l;
                ASSERT_LT(std::abs(from.y + slant.y * from.x), box.yReach) << degrees << ' ' << turn << ' ' << l;
              }
          }
    }
}

}  // namespace
}  // namespace tomales::test
