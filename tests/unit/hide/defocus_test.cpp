#include <gtest/gtest.h>

#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

constexpr float kScale_px = 32;  ///< Of raster x to x / z at 90 degrees and 64 pixels.
constexpr float kFocus = 5;      ///< Distance in focus.
constexpr float kLensRadius = 2.5f;
constexpr PixelRect kAll{0, 0, 64, 64};

/// A perspective camera with a lens, and one object.
World lensWorld(float lensRadius = kLensRadius) {
  Options o;
  o.xResolution = o.yResolution = 64;
  o.projection = ProjectionKind::Perspective;
  o.focalDistance = kFocus;
  o.focalLength = 2 * lensRadius;
  o.fStop = lensRadius > 0 ? 1 : kInfinity;
  World w(o);
  w.scene.options.shutterClose = 1;
  w.add();
  w.freeze();
  return w;
}

/// A square of `size` px around raster (x, y) at depth z.
Surface square(float x, float y, float size, float z) {
  return [=](float u, float v, int) {
    const float px = x + size * (u - 0.5f) - 32, py = y + size * (v - 0.5f) - 32;
    return vec3(px / kScale_px * z, -py / kScale_px * z, z);
  };
}

/// Radius of the circle of confusion of a thin lens, seen on a plane at unit distance (closed form).
float confusion_px(float z) { return kScale_px * kLensRadius * std::abs(1 / kFocus - 1 / z); }

TEST(Defocus, ASmallSquareSpreadsEvenlyOverTheCircleOfConfusion) {
  const World w = lensWorld();
  const SamplePattern pattern(8, 8, true, 5);
  for (const float z : {2.5f, 20.0f}) {
    const DeepTile t = hide(w, pattern, kAll, {raster(w, makeGrid(0, 1, 2, 2, square(32, 32, 1, z)))});
    const float radius = confusion_px(z);
    ASSERT_GT(radius, 10);
    double all = 0, inner = 0;
    float farthest = 0;
    forSamples(pattern, kAll, [&](int x, int y, int s, vec2 p, float) {
      if (!hits(t, x, y, s)) return;
      const float r = glm::length(p - vec2(32));
      all += 1.0 / 64;
      inner += r < radius * std::sqrt(0.5f) ? 1.0 / 64 : 0;
      farthest = std::max(farthest, r);
    });
    EXPECT_NEAR(all, 1, 0.2) << z;  // Energy: the square's own area, a pixel; 64 hits in the mean.
    EXPECT_NEAR(inner / all, 0.5, 0.2) << z;
    EXPECT_LT(farthest, radius + 0.71f);
    EXPECT_GT(farthest, 0.9f * radius);
  }
}

TEST(Defocus, EnergyAndDensityOfManySmallSquaresAreThoseOfADisk) {
  const World w = lensWorld();
  const float radius = confusion_px(20);
  double all = 0, inner = 0;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const SamplePattern pattern(8, 8, true, seed);
    const DeepTile t = hide(w, pattern, kAll, {raster(w, makeGrid(0, 1, 1, 1, square(32, 32, 2, 20)))});
    for (const Fragment& f : t.fragments) all += std::popcount(f.samples) / 64.0;
    forSamples(pattern, {24, 24, 40, 40}, [&](int x, int y, int s, vec2 p, float) {
      if (glm::length(p - vec2(32)) < radius / 2 && hits(t, x, y, s)) inner += 1.0 / 64;
    });
  }
  EXPECT_NEAR(all / 40, 4, 0.08);
  EXPECT_NEAR(inner / 40, 1, 0.06);
}

TEST(Defocus, EverySampleMeetsTheSquareWhereItsPointOfTheLensSeesIt) {
  const World w = lensWorld();
  const SamplePattern pattern(4, 4, true, 3);
  const auto r = raster(w, makeGrid(0, 1, 5, 3, square(30, 30, 9, 3)), false);
  EXPECT_TRUE(r->defocused);
  const DeepTile t = hide(w, pattern, kAll, {r});
  const float moved_px = kScale_px * kLensRadius * (1 / kFocus - 1.0f / 3);
  int covered = 0;
  forSamples(pattern, kAll, [&](int x, int y, int s, vec2 p, float) {
    const int k = pattern.patternOf(x, y);
    // Raster y runs down, and so does its share of the lens.
    const vec2 from = p - vec2(30) - moved_px * vec2(pattern.lensX(k)[s], -pattern.lensY(k)[s]);
    const float most = std::max(std::abs(from.x), std::abs(from.y));
    if (std::abs(most - 4.5f) < 0.01f) return;
    covered += most < 4.5f;
    ASSERT_EQ(hits(t, x, y, s), most < 4.5f ? 1 : 0) << p.x << " " << p.y;
  });
  EXPECT_GT(covered, 1000);
}

TEST(Defocus, TheFocalPlaneStaysAsSharpAsThroughAPinhole) {
  const World lens = lensWorld(), pinhole = lensWorld(0);
  const SamplePattern pattern(4, 4, true, 3);
  const auto grid = makeGrid(0, 1, 7, 7, square(31.3f, 30.2f, 7, kFocus));
  EXPECT_FALSE(raster(lens, grid)->defocused);
  const DeepTile a = hide(lens, pattern, kAll, {raster(lens, grid)}),
                 b = hide(pinhole, pattern, kAll, {raster(pinhole, grid)});
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) EXPECT_EQ(seen(a, x, y), seen(b, x, y));
}

TEST(Defocus, OfWhatMovesNowhereIsThatOfWhatIsStill) {
  const World w = lensWorld();
  World moving = lensWorld();
  moving.scene.objects[0].keyTimes = {0, 1};
  const SamplePattern pattern(4, 4, true, 3);
  const auto surface = square(31, 30, 6, 9);
  const DeepTile a = hide(w, pattern, kAll, {raster(w, makeGrid(0, 1, 3, 3, surface))});
  const DeepTile b = hide(moving, pattern, kAll, {raster(moving, makeGrid(0, 1, 3, 3, surface, 2))});
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) EXPECT_EQ(seen(a, x, y), seen(b, x, y));
}

TEST(Defocus, LeavesNoGapAndNoDoubleHitInATessellationThatRecedes) {
  const World w = lensWorld();
  const SamplePattern pattern(4, 4, true, 3);
  const Surface receding = [](float u, float v, int) {
    const float z = 3 + 9 * u;
    return vec3((2 * u - 1) * z * 1.5f, (2 * v - 1) * z * 1.5f, z);
  };
  const DeepTile t = hide(w, pattern, {24, 24, 40, 40}, {raster(w, makeGrid(0, 1, 40, 40, receding), false)});
  int wrong = 0;
  forSamples(pattern, t.rect, [&](int x, int y, int s, vec2, float) { wrong += hits(t, x, y, s) != 1; });
  EXPECT_EQ(wrong, 0);
}

TEST(Defocus, HiddenNeedsTheWholeBlurBehindSomething) {
  const World w = lensWorld();
  const Camera camera(w.scene.options);
  const SamplePattern pattern(4, 4, true, 3);
  Hider hider(w.scene, camera, pattern, kAll);
  hider.insert(raster(w, makeGrid(0, 1, 1, 1, square(16, 32, 64, kFocus))));  // Columns up to 48.
  const auto behind = raster(w, makeGrid(0, 2, 1, 1, square(40, 32, 2, 20)));
  EXPECT_NEAR(behind->bound.hi.x, 41 + confusion_px(20), 0.01f);
  EXPECT_FALSE(hider.hidden(behind->bound, 20));
  EXPECT_TRUE(hider.hidden({vec2(39, 31), vec2(41, 33)}, 20));
}

}  // namespace
}  // namespace tomales::test
