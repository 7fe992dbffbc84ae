#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

constexpr PixelRect kCoveredFrame{0, 0, 64, 64};

TEST(Coverage, OfAHalfPlaneIsItsAreaWithinTheErrorOfStratification) {
  World w;
  w.add();
  w.freeze();
  const auto edge = [](float y) { return 20.3f + 0.27f * y; };
  const auto g = makeGrid(0, 1, 30, 60, [&](float u, float v, int) {
    const float y = -1 + 66 * v;
    return at(lerp(-1, edge(y), u), y);
  });
  const SamplePattern pattern(8, 8, true, 5);
  const DeepTile t = hide(w, pattern, kCoveredFrame, {raster(w, g)});
  double squares = 0, bias = 0;
  int crossed = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      double area = 0;
      for (int k = 0; k < 512; ++k)
        area += std::clamp(edge(static_cast<float>(y) + (static_cast<float>(k) + 0.5f) / 512) - static_cast<float>(x),
                           0.0f, 1.0f) /
                512;
      const double error = coverage(t, x, y, 64) - area;
      if (area == 0 || area == 1) {
        ASSERT_EQ(error, 0) << x << "," << y;
        continue;
      }
      ++crossed;
      squares += error * error;
      bias += error;
    }
  ASSERT_GT(crossed, 60);
  EXPECT_LT(std::sqrt(squares / crossed), 0.035);  // Without strata: 0.05 and more.
  EXPECT_NEAR(bias / crossed, 0, 0.01);
}

/// A square lattice whose interior vertices are moved by up to `wobble` of a cell.
Surface wobbly(int n, float wobble, float lo, float hi) {
  return [=](float u, float v, int) {
    const int i = static_cast<int>(std::lround(u * static_cast<float>(n))),
              j = static_cast<int>(std::lround(v * static_cast<float>(n)));
    const uint32_t name = hashCombine(static_cast<uint32_t>(i), static_cast<uint32_t>(j));
    const float cell = (hi - lo) / static_cast<float>(n);
    const float dx = i == 0 || i == n ? 0 : wobble * (2 * unitFloat(hash32(name)) - 1);
    const float dy = j == 0 || j == n ? 0 : wobble * (2 * unitFloat(hash32(name + 1)) - 1);
    return at(lo + cell * (static_cast<float>(i) + dx), lo + cell * (static_cast<float>(j) + dy));
  };
}

void expectOneHitInside(const DeepTile& t, const SamplePattern& pattern, float lo, float hi) {
  int inside = 0, wrong = 0;
  forSamples(pattern, kCoveredFrame, [&](int x, int y, int s, vec2 p, float) {
    if (p.x == lo || p.x == hi || p.y == lo || p.y == hi) return;
    const bool in = p.x > lo && p.x < hi && p.y > lo && p.y < hi;
    inside += in;
    wrong += hits(t, x, y, s) != (in ? 1 : 0);
  });
  EXPECT_GT(inside, 10000);
  EXPECT_EQ(wrong, 0);
}

class Tessellation : public testing::TestWithParam<int> {};

TEST_P(Tessellation, EverySampleInsideIsHitOnceAndNoneOutside) {
  World w;
  w.add();
  w.freeze();
  const int n = GetParam();
  const SamplePattern pattern(4, 4, true, 5);
  const auto g = makeGrid(0, 1, n, n, wobbly(n, 0.2f, 4.25f, 59.5f));
  expectOneHitInside(hide(w, pattern, kCoveredFrame, {raster(w, g, false)}), pattern, 4.25f, 59.5f);
}
INSTANTIATE_TEST_SUITE_P(FineAndCoarse, Tessellation, testing::Values(1, 3, 11, 40, 150));

TEST(Tessellation, OfRegularSamplesOnVerticesAndEdgesHitsEachOnce) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern centres(1, 1, false, 0);
  // Every sample is a vertex shared by four cells.
  const auto g = makeGrid(0, 1, 60, 60, rectangle(1.5f, 1.5f, 61.5f, 61.5f));
  const DeepTile t = hide(w, centres, kCoveredFrame, {raster(w, g, false)});
  for (int y = 2; y < 61; ++y)
    for (int x = 2; x < 61; ++x) ASSERT_EQ(hits(t, x, y, 0), 1) << x << "," << y;
}

TEST(Tessellation, GridsWithBitEqualBordersLeaveNoGapAndHitNoSampleTwice) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern pattern(4, 4, true, 9);
  const auto border = [](float v) { return 30.1f + 4 * std::sin(7 * v) * (v > 0 && v < 1 ? 1.0f : 0.0f); };
  const auto left = makeGrid(
      0, 1, 9, 31, [&](float u, float v, int) { return at(lerp(4.25f, border(v), u), lerp(4.25f, 59.5f, v)); });
  const auto right = makeGrid(0, 2, 13, 31, [&](float u, float v, int) {
    return at(u == 0 ? border(v) : lerp(border(v), 59.5f, u), lerp(4.25f, 59.5f, v));
  });
  expectOneHitInside(hide(w, pattern, kCoveredFrame, {raster(w, left, false), raster(w, right, false)}), pattern, 4.25f,
                     59.5f);
}

/// Samples of the ring between two grids that join along an arc of radius 20, cut into 5 and into 8.
int samplesThatFallThrough(uint8_t innerOpen, uint8_t outerOpen) {
  World w;
  w.add();
  w.freeze();
  const auto ring = [](float r0, float r1) {
    return [=](float u, float v, int) {
      const float r = lerp(r0, r1, v), angle = u * kPi / 2;
      return at(5.3f + r * std::cos(angle), 5.1f + r * std::sin(angle));
    };
  };
  const auto inner = makeGrid(0, 1, 5, 4, ring(10, 20)), outer = makeGrid(0, 2, 8, 4, ring(20, 30));
  inner->pieces[0].openEdges = innerOpen;
  outer->pieces[0].openEdges = outerOpen;
  const SamplePattern pattern(8, 8, true, 2);
  const DeepTile t = hide(w, pattern, {0, 0, 40, 40}, {raster(w, inner), raster(w, outer)});
  int through = 0;
  forSamples(pattern, {0, 0, 40, 40}, [&](int x, int y, int s, vec2 p, float) {
    const vec2 from = p - vec2(5.3f, 5.1f);
    const float r = glm::length(from);
    if (from.x > 0 && from.y > 0 && r > 15 && r < 25) through += hits(t, x, y, s) == 0;
  });
  return through;
}

TEST(Crack, BetweenBordersOfDifferentRatesLetsNoSampleThrough) {
  EXPECT_GT(samplesThatFallThrough(kAllEdges, kAllEdges), 50);  // The crack is there.
  EXPECT_EQ(samplesThatFallThrough(kAllEdges & ~kEdgeV1, kAllEdges & ~kEdgeV0), 0);
}

TEST(Crack, StraightBordersReachOverByTwoThousandthsOfAPixelAndOpenOnesNotAtAll) {
  World w;
  w.add();
  w.freeze();
  const auto g = makeGrid(0, 1, 4, 4, rectangle(8, 8, 12, 12));
  g->pieces[0].openEdges = kEdgeU0 | kEdgeV0 | kEdgeV1;
  const auto r = raster(w, g);
  EXPECT_EQ(r->bound.lo, vec2(8, 8));
  EXPECT_EQ(r->bound.hi.y, 12);
  EXPECT_NEAR(r->bound.hi.x, 12.002f, 0.001f);
  EXPECT_EQ(r->x[3], 11);
}

TEST(Crack, BordersReachOverByHalfAPixelAtMost) {
  World w;
  w.add();
  w.freeze();
  const auto g =
      makeGrid(0, 1, 2, 2, [](float u, float v, int) { return at(10 + 10 * u + 20 * v * (1 - v) * u, 10 + 20 * v); });
  g->pieces[0].openEdges = kEdgeU0 | kEdgeV0 | kEdgeV1;
  EXPECT_NEAR(raster(w, g)->bound.hi.x, 25.5f, 0.001f);
}

TEST(Facing, OneSidedSurfacesHideTheirBack) {
  World w;
  Attributes oneSided;
  oneSided.sides = 1;
  w.add(oneSided);
  w.freeze();
  const SamplePattern pattern(2, 2, true, 0);
  const auto g = makeGrid(0, 1, 4, 4, rectangle(0, 0, 8, 8));
  EXPECT_EQ(coverage(hide(w, pattern, {0, 0, 8, 8}, {raster(w, g)}), 3, 3, 4), 1);
  std::fill_n(g->N(2), g->vertexCount(), 1.0f);  // Shading normals do not matter.
  EXPECT_EQ(coverage(hide(w, pattern, {0, 0, 8, 8}, {raster(w, g)}), 3, 3, 4), 1);
  const auto back = makeGrid(0, 1, 4, 4, rectangle(8, 0, 0, 8));
  EXPECT_EQ(coverage(hide(w, pattern, {0, 0, 8, 8}, {raster(w, back)}), 3, 3, 4), 0);
}

TEST(Facing, UnderPerspectiveIsDecidedAtThePoint) {
  Options o;
  o.xResolution = o.yResolution = 64;
  o.projection = ProjectionKind::Perspective;
  World w(o);
  Attributes oneSided;
  oneSided.sides = 1;
  w.add(oneSided);
  w.freeze();
  // Both walls of a corridor that widens lean away in N.z, but face the eye.
  const auto wall = [](float near, float far) {
    return makeGrid(0, 1, 4, 4, [=](float u, float v, int) {
      const float z = near + u * (far - near);
      return vec3(1 + 0.1f * z, v - 0.5f, z);
    });
  };
  const SamplePattern pattern(2, 2, true, 0);
  const PixelRect rect{0, 0, 64, 64};
  EXPECT_FALSE(hide(w, pattern, rect, {raster(w, wall(2, 4))}).fragments.empty());
  EXPECT_TRUE(hide(w, pattern, rect, {raster(w, wall(4, 2))}).fragments.empty());
}

/// What the samples of a pixel see, without names.
std::vector<std::tuple<float, uint64_t, uint16_t>> seenIn(const DeepTile& t, int x, int y) {
  std::vector<std::tuple<float, uint64_t, uint16_t>> out;
  const DeepPixel& p = t.pixel(x, y);
  for (uint32_t k = 0; k < p.count; ++k)
    out.emplace_back(begin(t, p)[k].z, begin(t, p)[k].samples, begin(t, p)[k].word);
  return out;
}

TEST(Coverage, OfCellsThatFitTheLatticeAndOthersIsTheSameInBucketsOfAnySize) {
  for (const auto& [columns, rows] : {std::pair{4, 4}, {10, 8}})
    for (const int n : {5, 9, 16}) {  // Edges of about 2.5 to 18 px.
      World w;
      w.add();
      w.freeze();
      const SamplePattern pattern(columns, rows, true, 3);
      const Rasters grids = {raster(w, makeGrid(0, 1, n, n, wobbly(n, 0.2f, 0, 64)), false)};
      const DeepTile whole = hide(w, pattern, kCoveredFrame, grids);
      expectOneHitInside(whole, pattern, 0, 64);
      for (const int size : {32, 16})
        for (int y0 = 0; y0 < 64; y0 += size)
          for (int x0 = 0; x0 < 64; x0 += size) {
            const DeepTile part = hide(w, pattern, {x0, y0, x0 + size, y0 + size}, grids);
            for (int y = y0; y < y0 + size; ++y)
              for (int x = x0; x < x0 + size; ++x)
                ASSERT_EQ(seenIn(part, x, y), seenIn(whole, x, y)) << n << " " << size << " " << x << "," << y;
          }
    }
}

TEST(Coverage, OfStackedPiecesIsThatOfTheirCells) {
  World w;
  w.add();
  w.freeze();
  for (int nu = 1; nu < 20; nu += 3)
    for (int nv = 1; nv < 5; ++nv) {
      const auto g = std::make_shared<Grid>();
      g->object = 0;
      g->pieces.resize(3);
      for (uint32_t p = 0; p < 3; ++p) {
        g->pieces[p].sampleKey = p;
        g->pieces[p].openEdges = kAllEdges;
      }
      g->allocate(nu, nv, 1, 0);
      const int row = nu + 1;
      for (int k = 0; k < g->vertexCount(); ++k) {
        const auto u = static_cast<float>(k % row), v = static_cast<float>(k / row % (nv + 1)),
                   p = static_cast<float>(k / (row * (nv + 1)));
        const vec3 at_ = at(2 + 2 * u, 3 + 20 * p + 2 * v);
        for (int axis = 0; axis < 3; ++axis) g->P(0, axis)[k] = at_[axis];
        g->N(2)[k] = -1;
      }
      size_t cells = 0;
      for (int number = 0; number < g->cellNumbers(); ++number) cells += g->isCell(number);
      EXPECT_EQ(hide(w, SamplePattern(4, 4, true, 1), kCoveredFrame, {raster(w, g)}).facets.size(), cells)
          << nu << " x " << nv;
    }
}

}  // namespace
}  // namespace tomales::test
