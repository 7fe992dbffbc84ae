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

Seen seenOf(float width_px, const std::string& attributes = {}) {
  // Orthographic: a pixel is 1/8.
  const DeepFrame f = hideRib("Format 16 16 1 PixelSamples 32 32 PixelFilter \"box\" 1 1 Projection \"orthographic\" ScreenWindow -1 1 -1 1 WorldBegin " + attributes +
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

TEST(Particles, OfOneSideAreSeenFromTheirFront) {
  EXPECT_GT(seenOf(1.7f, "Sides 1").area_px2, 2);
  EXPECT_EQ(seenOf(1.7f, "Sides 1 ReverseOrientation").area_px2, 0);
}

}  // namespace
}  // namespace tomales
