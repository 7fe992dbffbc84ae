// Particles: disks, however small.
#include <fmt/format.h>

#include "tests/unit/frame/hidden_body.h"

namespace tomales {
namespace {
using namespace test;

/// Samples that see something of one particle, and what shades them.
struct Seen {
  double area_px2 = 0;
  size_t facets = 0;
};

Seen seenOf(float width_px, const std::string& attributes = {}, const std::string& options = {}) {
  // Orthographic: a pixel is 1/8.
  const DeepFrame f = hideRib(
      "Format 16 16 1 PixelSamples 32 32 PixelFilter \"box\" 1 1 Projection \"orthographic\" ScreenWindow -1 1 -1 1 " +
      options + " WorldBegin " + attributes +
      fmt::format(" Points \"P\" [0.03 0.02 5] \"constantwidth\" [{}] WorldEnd", width_px / 8));
  Seen seen;
  for (int y = f.crop.y0; y < f.crop.y1; ++y)
    for (int x = f.crop.x0; x < f.crop.x1; ++x) seen.area_px2 += covered(f, x, y) / 1024.0;
  for (const DeepTile& t : f.tiles) seen.facets += t.facets.size();
  return seen;
}

TEST(Particles, CoverTheAreaOfADisk) {
  for (const float width_px : {0.4f, 1.0f, 1.7f, 2.5f, 6.0f}) {
    const double area = M_PI / 4 * width_px * width_px;
    EXPECT_NEAR(seenOf(width_px).area_px2, area, 0.02 * area + 0.002) << width_px;
    EXPECT_NEAR(seenOf(width_px, "Opacity [0.5 0.5 0.5]").area_px2, area, 0.02 * area + 0.002) << width_px;
  }
}

TEST(Particles, AreShadedOnceWhereTheyAreSmall) {
  EXPECT_EQ(seenOf(1.7f).facets, 1u);
  EXPECT_GT(seenOf(6).facets, 8u);
  EXPECT_GT(seenOf(1.7f, "ShadingRate 0.1").facets, 8u);
}

/// Mean alpha of a frame of 64 x 64, perspective.
double coverageOf(const std::string& disks) {
  const DeepFrame f = hideRib(
      "Format 64 64 1 PixelSamples 4 4 PixelFilter \"box\" 1 1 Clipping 0.1 100 Projection \"perspective\" \"fov\" "
      "[60] WorldBegin " +
      disks + " WorldEnd");
  double samples = 0;
  for (int y = f.crop.y0; y < f.crop.y1; ++y)
    for (int x = f.crop.x0; x < f.crop.x1; ++x) samples += covered(f, x, y);
  return samples / (16.0 * 64 * 64);
}

TEST(Particles, ThatPassTheEyeAreSeenInFrontOfIt) {
  EXPECT_GT(coverageOf("Points \"P\" [0 -0.5 3] \"N\" [0 1 0] \"constantwidth\" [8]"), 0.4);
}

TEST(Particles, OfManySizesAreAllSeen) {
  const double small = coverageOf("Points \"P\" [-0.5 0 3] \"constantwidth\" [0.08]"),
               large = coverageOf("Points \"P\" [0.5 0 3] \"constantwidth\" [0.8]");
  EXPECT_GT(small, 0);
  EXPECT_NEAR(coverageOf("Points \"P\" [-0.5 0 3 0.5 0 3 0 0 -3 9 0 3] \"width\" [0.08 0.8 0.1 0.1]"), small + large,
              1e-6);
}

TEST(Particles, ThatMoveOrAreDisplacedAreShadedInMorePlaces) {
  EXPECT_GT(seenOf(1.7f, "MotionBegin [0 1] Translate 0 0 0 Translate 0.2 0 0 MotionEnd", "Shutter 0 1").facets, 1u);
  EXPECT_GT(seenOf(1.7f, "Displacement \"bumpy\" Attribute \"displacementbound\" \"float sphere\" [0.01]").facets, 1u);
}

TEST(Particles, OfOneSideAreSeenFromTheirFront) {
  EXPECT_GT(seenOf(1.7f, "Sides 1").area_px2, 2);
  EXPECT_EQ(seenOf(1.7f, "Sides 1 ReverseOrientation").area_px2, 0);
}

}  // namespace
}  // namespace tomales
