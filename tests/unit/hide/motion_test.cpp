#include <gtest/gtest.h>

#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

/// A rectangle of unit width at (10, 10) of raster space, moved along x by offset[key].
struct Moving {
  World world;
  std::shared_ptr<Grid> grid;

  Moving(const std::vector<float>& times, const std::vector<float>& offset, float height = 1) {
    world.scene.options.shutterOpen = 2;
    world.scene.options.shutterClose = 4;
    world.add();
    world.freeze();
    world.scene.objects[0].keyTimes.clear();
    for (const float t : times) world.scene.objects[0].keyTimes.push_back(2 + 2 * t);
    grid = makeGrid(
        0, 1, 3, 3,
        [&](float u, float v, int key) { return at(10 + u + offset[static_cast<size_t>(key)], 10 + height * v); },
        static_cast<int>(times.size()));
  }
};

constexpr PixelRect kMovingRect{8, 8, 24, 14};

TEST(Motion, ASquareThatCrossesPixelsCoversThemAsLongAsItIsThere) {
  Moving m({0, 1}, {0, 4}, 32);
  const SamplePattern pattern(16, 16, true, 3);
  const DeepTile t = hide(m.world, pattern, {8, 10, 24, 42}, {raster(m.world, m.grid)});
  // Speed 4 px a shutter: the integral of 1 - |4 t - k| over the time that it is positive.
  const float expected[] = {0.125f, 0.25f, 0.25f, 0.25f, 0.125f, 0};
  for (int k = 0; k < 6; ++k) {
    float sum = 0, squares = 0;
    for (int y = 10; y < 42; ++y) {
      const float error = coverage(t, 10 + k, y, 256) - expected[k];
      sum += error;
      squares += error * error;
    }
    EXPECT_NEAR(sum / 32, 0, 0.007f) << k;
    EXPECT_LT(std::sqrt(squares / 32), 0.017f) << k;  // Times independent of columns: 0.027.
  }
}

TEST(Motion, EverySampleMeetsTheSquareWhereItIsAtItsTime) {
  Moving m({0, 0.25f, 1}, {0, 6, 2});
  const SamplePattern pattern(8, 8, true, 3);
  const auto r = raster(m.world, m.grid, false);
  EXPECT_EQ(r->bound.hi.x, 17);
  const DeepTile t = hide(m.world, pattern, kMovingRect, {r});
  int covered = 0;
  forSamples(pattern, kMovingRect, [&](int x, int y, int s, vec2 p, float time) {
    const float x0 = 10 + (time < 0.25f ? 24 * time : lerp(6, 2, (time - 0.25f) / 0.75f));
    const float margin = std::min(std::min(std::abs(p.x - x0), std::abs(p.x - x0 - 1)),
                                  std::min(std::abs(p.y - 10), std::abs(p.y - 11)));
    if (margin < 1e-4f) return;
    const bool in = p.x > x0 && p.x < x0 + 1 && p.y > 10 && p.y < 11;
    covered += in;
    ASSERT_EQ(hits(t, x, y, s), in ? 1 : 0) << p.x << " " << p.y << " at " << time;
  });
  EXPECT_GT(covered, 40);
}

TEST(Motion, OfNothingGivesTheStillPicture) {
  Moving m({0, 1}, {0.3f, 0.3f});
  const auto still = makeGrid(0, 1, 3, 3, rectangle(10.3f, 10, 11.3f, 11));
  const SamplePattern pattern(8, 8, true, 3);
  const DeepTile a = hide(m.world, pattern, kMovingRect, {raster(m.world, m.grid)});
  const DeepTile b = hide(m.world, pattern, kMovingRect, {raster(m.world, still)});
  for (int y = kMovingRect.y0; y < kMovingRect.y1; ++y)
    for (int x = kMovingRect.x0; x < kMovingRect.x1; ++x) EXPECT_EQ(seen(a, x, y), seen(b, x, y));
}

TEST(Motion, InDepthChangesWhoIsInFront) {
  Moving m({0, 1}, {0, 0});
  const auto mover = makeGrid(
      0, 1, 1, 1, [](float u, float v, int key) { return at(8 + 8 * u, 8 + 8 * v, key ? 3.0f : 1.0f); }, 2);
  const auto still = makeGrid(0, 2, 1, 1, rectangle(8, 8, 16, 16, 2));
  const SamplePattern pattern(4, 4, true, 3);
  const DeepTile t = hide(m.world, pattern, {9, 9, 12, 12}, {raster(m.world, mover), raster(m.world, still)});
  forSamples(pattern, t.rect, [&](int x, int y, int s, vec2, float time) {
    if (std::abs(time - 0.5f) < 1e-4f) return;
    const DeepPixel& p = t.pixel(x, y);
    for (uint32_t k = 0; k < p.count; ++k) {
      if (begin(t, p)[k].samples >> s & 1U) {
        ASSERT_EQ(begin(t, p)[k].z == 2, time > 0.5f);
      }
    }
  });
}

}  // namespace
}  // namespace tomales::test
