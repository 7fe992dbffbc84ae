// Transparent neighbours reach over each other and count once.
#include <gtest/gtest.h>

#include <bit>

#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

constexpr PixelRect kRect{0, 0, 32, 32};

/// The sum over the samples of a pixel of the layers that each sees.
int layersOf(const DeepTile& t, const DeepPixel& p) {
  int n = 0;
  for (uint32_t k = 0; k < p.count; ++k) n += std::popcount(begin(t, p)[k].samples);
  return n;
}

std::shared_ptr<Grid> joined(std::shared_ptr<Grid> grid, uint8_t openEdges) {
  grid->pieces[0].openEdges = openEdges;
  return grid;
}

/// Two sheets that share a bent border and have different rates along it, in a plane of some slope or on a bowl.
Rasters bentSheets(World& w, float slope, float bowl, float z) {
  const auto point = [=](float x, float y) {
    const float dx = (x - 16) / 16, dy = (y - 16) / 16;
    return at(x, y, z + slope * x + bowl * (dx * dx + dy * dy));
  };
  const auto border = [](float v) { return 15.3f + 3 * std::sin(3 * v); };
  const Surface left = [=](float u, float v, int) { return point(lerp(-2.0f, border(v), u), -2 + 36 * v); };
  const Surface right = [=](float u, float v, int) { return point(lerp(border(v), 34.0f, u), -2 + 36 * v); };
  return {raster(w, joined(makeGrid(0, 1, 6, 9, left), kAllEdges & ~kEdgeU1), false),
          raster(w, joined(makeGrid(0, 2, 5, 14, right), kAllEdges & ~kEdgeU0), false)};
}

TEST(BorderOverlap, NeighboursOfOneSurfaceCountOnce) {
  for (const auto& [slope, bowl] : {std::pair{0.0f, 0.0f}, {0.5f, 0.0f}, {0.0f, 6.0f}}) {
    World w;
    w.add();
    w.freeze();
    const DeepTile t = hide(w, SamplePattern(4, 4, true, 1), kRect, bentSheets(w, slope, bowl, 10));
    for (const DeepPixel& p : t.pixels) ASSERT_EQ(layersOf(t, p), 16) << slope << " " << bowl;
  }
}

TEST(BorderOverlap, SamplesOnTheBorderBelongToOneOfFourSheets) {
  World w;
  w.add();
  w.freeze();
  Rasters sheets;
  for (int k = 0; k < 4; ++k) {
    const float x = k % 2 ? 16.5f : -1.5f, y = k / 2 ? 16.5f : -1.5f;
    const Surface sheet = [=](float u, float v, int) { return at(x + 18 * u, y + 18 * v, 10); };
    const int open = kAllEdges & ~(k % 2 ? kEdgeU0 : kEdgeU1) & ~(k / 2 ? kEdgeV0 : kEdgeV1);
    sheets.push_back(
        raster(w, joined(makeGrid(0, static_cast<uint32_t>(k + 1), 9, 9, sheet), static_cast<uint8_t>(open)), false));
  }
  const DeepTile t = hide(w, SamplePattern(1, 1, false, 1), kRect, sheets);
  for (const DeepPixel& p : t.pixels) ASSERT_EQ(layersOf(t, p), 1);
}

TEST(BorderOverlap, LayersOfOneObjectCountEach) {
  World w;
  w.add();
  w.freeze();
  Rasters all = bentSheets(w, 0, 6, 10);
  for (const auto& r : bentSheets(w, 0, 6, 20)) all.push_back(r);
  const DeepTile t = hide(w, SamplePattern(4, 4, true, 1), kRect, all);
  for (const DeepPixel& p : t.pixels) ASSERT_EQ(layersOf(t, p), 32);
}

/// A sheet folded along a line that is seen edge on: both sides end there, on the same side.
TEST(BorderOverlap, SidesOfAFoldCountBoth) {
  World w;
  w.add();
  w.freeze();
  const auto side = [&](uint32_t name, float slope) {
    const Surface s = [=](float u, float v, int) { return at(20 - 22 * u, -2 + 36 * v, 10 + slope * u); };
    return raster(w, joined(makeGrid(0, name, 22, 36, s), kAllEdges & ~kEdgeU0), false);
  };
  const DeepTile t = hide(w, SamplePattern(4, 4, true, 1), kRect, {side(1, 0), side(2, 8)});
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 20; ++x) ASSERT_EQ(layersOf(t, t.pixel(x, y)), 32) << x << " " << y;
}

}  // namespace
}  // namespace tomales::test
