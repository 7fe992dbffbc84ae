#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "reyes/base/rng.h"
#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

/// Tilted, coincident, moving, transparent, smooth and one-sided grids, all over a frame of 64 x 64 pixels.
struct Soup {
  World world;
  Rasters rasters;

  Soup() {
    world.scene.options.shutterClose = 1;
    Attributes smooth, oneSided;
    smooth.interpolation = ShadingInterpolation::Smooth;
    oneSided.sides = 1;
    world.add();
    world.add(smooth);
    world.add(oneSided);
    world.freeze();
    for (Object& o : world.scene.objects) o.keyTimes = {0, 1};
    for (uint32_t k = 0; k < 60; ++k) rasters.push_back(one(k));
  }

  std::shared_ptr<const RasterGrid> one(uint32_t name) const {
    const auto random = [&](uint32_t dimension) { return unitFloat(hashCombine(name, dimension)); };
    const float x = 60 * random(0) - 5, y = 60 * random(1) - 5, size = 5 + 25 * random(2), turn = random(3);
    const float z = std::floor(3 * random(4)) + 1,
                slope = name % 3 ? 0 : random(5);  // Two thirds share three planes.
    const float move = 6 * random(6);
    const auto g = makeGrid(
        static_cast<int>(name % 3), hash32(name), 7, 9,
        [&](float u, float v, int key) {
          return at(x + size * (u - turn * v) + move * static_cast<float>(key), y + size * (v + turn * u),
                    z + slope * u);
        },
        name % 5 ? 1 : 2);
    g->pieces[0].openEdges = static_cast<uint8_t>(name & 15U);
    return raster(world, g, name % 4 != 0);
  }
};

bool sameBatch(const ShadePoints& a, const ShadePoints& b) {
  if (a.group() != b.group() || a.count() != b.count() || a.channelCount() != b.channelCount()) return false;
  for (int c = 0; c < a.channelCount(); ++c)
    if (!std::equal(a.channel(c), a.channel(c) + a.count(), b.channel(c))) return false;
  for (int i = 0; i < a.count(); ++i)
    if (a.key(i) != b.key(i)) return false;
  return true;
}

TEST(Resolve, DoesNotDependOnTheOrderOfGrids) {
  Soup soup;
  const SamplePattern pattern(4, 4, true, 1);
  const DeepTile a = hide(soup.world, pattern, {0, 0, 64, 64}, soup.rasters);
  EXPECT_GT(a.fragments.size(), 8000U);
  for (uint32_t shuffle = 0; shuffle < 4; ++shuffle) {
    for (size_t k = soup.rasters.size() - 1; k > 0; --k)
      std::swap(soup.rasters[k], soup.rasters[hashCombine(shuffle, static_cast<uint32_t>(k)) % (k + 1)]);
    const DeepTile b = hide(soup.world, pattern, {0, 0, 64, 64}, soup.rasters);
    ASSERT_EQ(a.facets.size(), b.facets.size());
    for (size_t k = 0; k < a.facets.size(); ++k) {
      ASSERT_EQ(a.facets[k].batch, b.facets[k].batch);
      ASSERT_TRUE(std::equal(a.facets[k].point, a.facets[k].point + 4, b.facets[k].point));
    }
    ASSERT_EQ(a.batches.size(), b.batches.size());
    for (size_t k = 0; k < a.batches.size(); ++k) ASSERT_TRUE(sameBatch(a.batches[k], b.batches[k]));
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) ASSERT_EQ(seen(a, x, y), seen(b, x, y)) << x << "," << y;
  }
}

/// Grids of one piece as one of many.
std::shared_ptr<Grid> stacked(const std::vector<std::shared_ptr<Grid>>& grids) {
  auto all = std::make_shared<Grid>();
  all->object = grids[0]->object;
  all->pieces.clear();
  for (const auto& g : grids) all->pieces.push_back(g->pieces[0]);
  all->allocate(grids[0]->nu, grids[0]->nv, 1, 0);
  int first = 0;
  for (const auto& g : grids) {
    for (int axis = 0; axis < 3; ++axis) {
      std::copy_n(g->P(0, axis), g->vertexCount(), all->P(0, axis) + first);
      std::copy_n(g->N(axis), g->vertexCount(), all->N(axis) + first);
    }
    std::copy_n(g->u(), g->vertexCount(), all->u() + first);
    std::copy_n(g->v(), g->vertexCount(), all->v() + first);
    first += g->vertexCount();
  }
  return all;
}

TEST(Resolve, PiecesThatShareAGridLookAsTheyDoAlone) {
  const SamplePattern pattern(4, 4, true, 1);
  for (const auto interpolation : {ShadingInterpolation::Constant, ShadingInterpolation::Smooth})
    for (const bool opaque : {true, false}) {
      World w;
      Attributes attributes;
      attributes.interpolation = interpolation;
      w.add(attributes);
      w.freeze();
      std::vector<std::shared_ptr<Grid>> grids;
      Rasters alone;
      for (uint32_t k = 0; k < 60; ++k) {
        const auto random = [&](uint32_t dimension) { return unitFloat(hashCombine(k, dimension, 7U)); };
        const float x = 66 * random(0) - 4, y = 66 * random(1) - 4, z = 1 + std::floor(4 * random(2)), turn = random(3);
        grids.push_back(makeGrid(0, hash32(k), 2, 3, [&](float u, float v, int) {
          return at(x + 9 * (u - turn * v), y + 9 * (v + turn * u), z + random(4) * u);
        }));
        grids.back()->pieces[0].openEdges = static_cast<uint8_t>(k & 15U);
        alone.push_back(raster(w, grids.back(), opaque));
      }
      const Rasters shared = {raster(w, stacked(grids), opaque)};
      EXPECT_EQ(shared[0]->ofPiece.size(), grids.size());
      for (const int size : {64, 16})
        for (int y0 = 0; y0 < 64; y0 += size)
          for (int x0 = 0; x0 < 64; x0 += size) {
            const PixelRect rect{x0, y0, x0 + size, y0 + size};
            const DeepTile a = hide(w, pattern, rect, alone), b = hide(w, pattern, rect, shared);
            for (int y = y0; y < y0 + size; ++y)
              for (int x = x0; x < x0 + size; ++x) ASSERT_EQ(seen(a, x, y), seen(b, x, y)) << x << "," << y;
          }
    }
}

void expectNoTraceOfBuckets(int samples) {
  Soup soup;
  const SamplePattern pattern(samples, samples, true, 1);
  const DeepTile whole = hide(soup.world, pattern, {0, 0, 64, 64}, soup.rasters);
  for (const int size : {8, 16})
    for (int y0 = 0; y0 < 64; y0 += size)
      for (int x0 = 0; x0 < 64; x0 += size) {
        const DeepTile part = hide(soup.world, pattern, {x0, y0, x0 + size, y0 + size}, soup.rasters);
        for (int y = y0; y < y0 + size; ++y)
          for (int x = x0; x < x0 + size; ++x) ASSERT_EQ(seen(part, x, y), seen(whole, x, y)) << x << "," << y;
      }
}

TEST(Resolve, DoesNotDependOnTheSizeOfBuckets) { expectNoTraceOfBuckets(4); }

// The whole frame as one bucket is more samples than are culled at once.
TEST(Resolve, DoesNotDependOnTheSizeOfBucketsWithManySamples) { expectNoTraceOfBuckets(9); }

/// Lets Highway choose among some of the vector widths only, while it lives.
class Widths {
 public:
  explicit Widths(int64_t targets) { hwy::GetChosenTarget().Update(targets); }
  ~Widths() { hwy::GetChosenTarget().DeInit(); }
};

TEST(Resolve, HasTheSameBitsForEveryVectorWidth) {
  Soup soup;
  const SamplePattern pattern(5, 5, true, 1);
  const PixelRect rect{0, 0, 64, 64};
  const DeepTile widest = hide(soup.world, pattern, rect, soup.rasters);
  const int64_t supported = hwy::SupportedTargets();
  for (const int64_t target : {HWY_EMU128, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
    if (!(supported & target)) continue;  // One for each that is compiled: reyes/base/vector.h
    const Widths one(target);
    const DeepTile tile = hide(soup.world, pattern, rect, soup.rasters);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x)
        ASSERT_EQ(seen(tile, x, y), seen(widest, x, y)) << hwy::TargetName(target) << " " << x << "," << y;
  }
}

TEST(Resolve, EveryFragmentOfAPixelIsNearestFirstAndHasItsOwnSamples) {
  Soup soup;
  const DeepTile t = hide(soup.world, SamplePattern(4, 4, true, 1), {0, 0, 64, 64}, soup.rasters);
  for (const DeepPixel& p : t.pixels)
    for (uint32_t k = 0; k < p.count; ++k) {
      ASSERT_NE(begin(t, p)[k].samples, 0U);
      ASSERT_LT(begin(t, p)[k].facet, t.facets.size());
      ASSERT_LE(begin(t, p)[k > 0 ? k - 1 : 0].z, begin(t, p)[k].z);
    }
}

/// Every sample of a frame that one grid of nu x nv cells fills, of which each is seen.
void expectWhole(const SamplePattern& pattern, const PixelRect& rect, int nu, int nv) {
  World w;
  w.add();
  w.freeze();
  const auto x0 = static_cast<float>(rect.x0), y0 = static_cast<float>(rect.y0), x1 = static_cast<float>(rect.x1),
             y1 = static_cast<float>(rect.y1);
  const Surface slope = [=](float u, float v, int) { return at(lerp(x0, x1, u), lerp(y0, y1, v), 5 - u - 0.1f * v); };
  const DeepTile t = hide(w, pattern, rect, {raster(w, makeGrid(0, 1, nu, nv, slope))});
  EXPECT_EQ(t.facets.size(), static_cast<size_t>(nu * nv));
  forSamples(pattern, rect,
             [&](int x, int y, int s, const vec2&, float) { ASSERT_EQ(hits(t, x, y, s), 1) << x << "," << y; });
  for (const DeepPixel& p : t.pixels)
    for (uint32_t k = 1; k < p.count; ++k) ASSERT_LE(begin(t, p)[k - 1].z, begin(t, p)[k].z);
}

// More pixels than are listed at once.
TEST(Resolve, SixteenLargeCellsOfOneBucketAreAllSeen) {
  expectWhole(SamplePattern(4, 4, true, 1), {0, 0, 64, 64}, 4, 4);
}

TEST(Resolve, MoreCellsOfAPixelThanAVectorHoldsAreAllSeen) {
  expectWhole(SamplePattern(8, 8, false, 1), {3, 5, 4, 6}, 8, 8);
}

TEST(Resolve, MoreThanSixtyFourSamplesTakeSeveralWords) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern pattern(12, 9, true, 1);
  const DeepTile t = hide(w, pattern, {0, 0, 4, 4}, {raster(w, makeGrid(0, 1, 1, 1, rectangle(-1, -1, 9, 9)))});
  for (const DeepPixel& p : t.pixels) {
    ASSERT_EQ(p.count, 2U);
    EXPECT_EQ(begin(t, p)[0].word, 0);
    EXPECT_EQ(begin(t, p)[0].samples, ~uint64_t{0});
    EXPECT_EQ(begin(t, p)[1].word, 1);
    EXPECT_EQ(begin(t, p)[1].samples, (uint64_t{1} << (108 - 64)) - 1);
    EXPECT_EQ(begin(t, p)[0].facet, begin(t, p)[1].facet);
  }
}

/// One cell, 4 px by 2 px at depth 3, with a primitive variable.
std::shared_ptr<Grid> oneCell() {
  auto g = std::make_shared<Grid>();
  g->object = 0;
  g->pieces[0].sampleKey = 42;
  g->pieces[0].openEdges = kAllEdges;
  g->allocate(1, 1, 1, 2);
  for (int k = 0; k < 4; ++k) {
    const vec3 p = at(static_cast<float>(k % 2) * 4, static_cast<float>(k / 2) * 2, 3);
    for (int axis = 0; axis < 3; ++axis) g->P(0, axis)[k] = p[axis];
    g->N(2)[k] = -2;
    g->u()[k] = 0.5f + 0.25f * static_cast<float>(k % 2);
    g->v()[k] = 0.5f * static_cast<float>(k / 2);
    g->primvar(0)[k] = static_cast<float>(k);
    g->primvar(1)[k] = 7;
  }
  return g;
}

std::vector<Primvar> twoPrimvars() {
  return {{"heat", Storage::Varying, ValueType::Float, 1, {}}, {"t", Storage::Varying, ValueType::Float, 1, {}}};
}

TEST(Resolve, ConstantShadingHasOnePointAtTheCentreOfAMicropolygon) {
  World w;
  Attributes a;
  a.textureCoordinates = {vec2{0, 0}, vec2{2, 0}, vec2{0, 1}, vec2{2, 1}};
  w.add(a, twoPrimvars());
  w.freeze();
  const DeepTile t = hide(w, SamplePattern(2, 2, true, 1), {0, 0, 4, 2}, {raster(w, oneCell())});
  ASSERT_EQ(t.facets.size(), 1U);
  ASSERT_EQ(t.batches.size(), 1U);
  const ShadePoints& p = t.batches[0];
  ASSERT_EQ(p.count(), 1);
  EXPECT_EQ(p.position(0), at(2, 1, 3));
  EXPECT_EQ(p.get3(kNx, 0), vec3(0, 0, -1));
  EXPECT_EQ(p.get3(kNgx, 0), vec3(0, 0, -1));
  EXPECT_EQ(p.get3(kIx, 0), vec3(0, 0, 1));
  EXPECT_EQ(p.get3(kDpduX, 0), vec3(16, 0, 0));
  EXPECT_EQ(p.get3(kDpdvX, 0), vec3(0, -4, 0));
  EXPECT_EQ(p.channel(kDu)[0], 0.25f);
  EXPECT_EQ(p.channel(kDv)[0], 0.5f);
  EXPECT_EQ(p.channel(kArea)[0], 8);
  EXPECT_EQ(p.channel(kU)[0], 0.625f);
  EXPECT_EQ(p.channel(kV)[0], 0.25f);
  EXPECT_EQ(p.channel(kS)[0], 1.25f);  // TextureCoordinates
  EXPECT_EQ(p.channel(kT)[0], 7);      // Primitive variable
  EXPECT_EQ(p.primvar(0)[0], 1.5f);
  EXPECT_EQ(p.primvar(1)[0], 7);
}

TEST(Resolve, SmoothShadingSharesCornersAndKnowsThePlaceOnTheFacet) {
  World w;
  Attributes smooth;
  smooth.interpolation = ShadingInterpolation::Smooth;
  w.add(smooth);
  w.freeze();
  const DeepTile t =
      hide(w, SamplePattern(1, 1, false, 1), {0, 0, 12, 8}, {raster(w, makeGrid(0, 9, 3, 2, rectangle(0, 0, 12, 8)))});
  ASSERT_EQ(t.facets.size(), 6U);
  EXPECT_EQ(t.batches[0].count(), 12);
  const Fragment& f = *begin(t, t.pixel(5, 6));
  const Facet& facet = t.facets[f.facet];
  const vec3 corners[] = {at(4, 4), at(8, 4), at(4, 8), at(8, 8)};
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(t.batches[0].position(facet.point[k]), corners[k]);
    EXPECT_NEAR(t.batches[0].channel(kArea)[facet.point[k]], 16, 1e-4);
    EXPECT_NEAR(t.batches[0].channel(kDpduX)[facet.point[k]], 12, 1e-4);
  }
  EXPECT_EQ(f.u, std::floor(256 * 1.5f / 4));
  EXPECT_EQ(f.v, std::floor(256 * 2.5f / 4));
}

TEST(Fragment, TheWeightsOfItsCornersAreThoseOfItsPlaceAndSumToExactlyOne) {
  for (int x = 0; x <= 1000; ++x)
    for (int y = 0; y <= 1000; y += 50) {
      const vec2 at = vec2(x, y) / 1000.0f;
      Fragment f{};
      f.setPosition(at);
      const auto w = f.cornerWeights();
      ASSERT_EQ(w[0] + w[1] + w[2] + w[3], 1.0f) << x << " " << y;
      ASSERT_NEAR(w[1] + w[3], at.x, 1.0 / 512 + 1e-6);
      ASSERT_NEAR(w[2] + w[3], at.y, 1.0 / 512 + 1e-6);
    }
}

TEST(Resolve, StillHasTheGridsOfSolidsWhenThoseThatNobodySeesAreLetGoOf) {
  World w;
  w.add();
  w.add();
  Solid solid;
  solid.add(SolidOperation::Union, -1);
  w.scene.objects[0].solid = 0;
  w.scene.objects[0].solidBlock = solid.add(SolidOperation::Primitive, 0);
  w.scene.solids.push_back(solid);
  w.freeze();
  Rasters rasters = {raster(w, makeGrid(0, 1, 2, 2, rectangle(0, 0, 4, 4, 1))),
                     raster(w, makeGrid(0, 2, 2, 2, rectangle(4, 0, 0, 4, 2)))};
  // Each hides the one before.
  for (uint32_t k = 0; k < 6000; ++k)
    rasters.push_back(raster(w, makeGrid(1, 3 + k, 1, 1, rectangle(4, 0, 8, 4, 10 - 0.001f * static_cast<float>(k)))));
  const DeepTile t = hide(w, SamplePattern(2, 2, true, 1), {0, 0, 8, 4}, rasters);
  ASSERT_EQ(t.pixel(1, 1).count, 1U);
  EXPECT_EQ(begin(t, t.pixel(1, 1))->z, 1);
  EXPECT_NEAR(begin(t, t.pixel(6, 1))->z, 4.001f, 1e-3f);
}

TEST(Resolve, FacesTheGeometricNormalAsTheShadingNormal) {
  World w;
  w.add({}, twoPrimvars());
  w.freeze();
  const auto g = oneCell();
  for (int k = 0; k < 4; ++k) {
    g->N(2)[k] = 1;
    g->N(0)[k] = 0.5f;
  }
  const DeepTile t = hide(w, SamplePattern(2, 2, true, 1), {0, 0, 4, 2}, {raster(w, g)});
  EXPECT_EQ(t.batches[0].get3(kNgx, 0), vec3(0, 0, 1));
}

}  // namespace
}  // namespace tomales::test
