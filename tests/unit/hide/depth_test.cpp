#include <gtest/gtest.h>

#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

constexpr PixelRect kRect{0, 0, 16, 16};

TEST(Depth, FilmsBecomeFragmentsNearestFirst) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern pattern(4, 4, true, 1);
  Rasters films;
  for (const float z : {5.0f, 2.0f, 7.0f, 3.0f, 6.0f, 4.0f})
    films.push_back(
        raster(w, makeGrid(0, static_cast<uint32_t>(z), 1, 1, rectangle(-1, -1, 17, 20, z)), false));
  const DeepTile t = hide(w, pattern, kRect, films);
  for (const DeepPixel& p : t.pixels) {
    float z = 2;
    uint64_t samples[6] = {};
    for (uint32_t k = 0; k < p.count; ++k) {
      const Fragment& f = begin(t, p)[k];
      ASSERT_EQ(f.z, z);
      samples[static_cast<size_t>(z) - 2] |= f.samples;
      if (k + 1 < p.count && begin(t, p)[k + 1].z > z) ++z;
    }
    for (const uint64_t s : samples) ASSERT_EQ(s, 0xffffU);
  }
}

TEST(Depth, AnOpaqueSurfaceEndsTheListOfFilms) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern pattern(2, 2, true, 1);
  const auto sheet = [&](float z, bool opaque) {
    return raster(w, makeGrid(0, static_cast<uint32_t>(z), 1, 1, rectangle(-1, -1, 40, 40, z)), opaque);
  };
  const DeepTile t = hide(
      w, pattern, kRect, {sheet(6, false), sheet(2, false), sheet(4, true), sheet(5, true), sheet(3, false)});
  for (const DeepPixel& p : t.pixels) {
    ASSERT_EQ(p.count, 3U);
    for (uint32_t k = 0; k < 3; ++k) ASSERT_EQ(begin(t, p)[k].z, 2 + static_cast<float>(k));
  }
}

TEST(Depth, InterpenetratingSurfacesAreSortedSampleBySample) {
  World w;
  w.add(), w.add();
  w.freeze();
  ASSERT_NE(w.scene.objects[0].group, w.scene.objects[1].group);
  const auto a = makeGrid(0, 1, 3, 3, [](float u, float v, int) { return at(16 * u, 16 * v, 1 + u); });
  const auto b = makeGrid(1, 2, 5, 2, [](float u, float v, int) { return at(16 * u, 16 * v, 2 - u); });
  const SamplePattern pattern(4, 4, true, 1);
  const DeepTile t = hide(w, pattern, kRect, {raster(w, a), raster(w, b)});
  forSamples(pattern, kRect, [&](int x, int y, int s, vec2 p, float) {
    if (std::abs(p.x - 8) < 0.001f) return;
    const DeepPixel& pixel = t.pixel(x, y);
    for (uint32_t k = 0; k < pixel.count; ++k) {
      const Fragment& f = begin(t, pixel)[k];
      if (f.samples >> s & 1U) {
        ASSERT_EQ(groupOf(t, f), w.scene.objects[p.x < 8 ? 0 : 1].group);
      }
    }
  });
}

TEST(Depth, UnderPerspectiveIsThatOfThePlane) {
  Options o;
  o.xResolution = o.yResolution = 16;
  o.projection = ProjectionKind::Perspective;
  World w(o);
  w.add();
  w.freeze();
  // One large micropolygon, steep in depth: z = 10 + 4 x.
  const auto g = makeGrid(0, 1, 1, 1, [](float u, float v, int) {
    const float x = -2 + 22 * u;
    return vec3(x, -120 + 240 * v, 10 + 4 * x);
  });
  const Camera camera(o);
  const SamplePattern centres(1, 1, false, 0);
  const DeepTile t = hide(w, centres, kRect, {raster(w, g)});
  int seenPixels = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const DeepPixel& p = t.pixel(x, y);
      if (p.count == 0) continue;
      const auto planeZ = [&](float shift) {
        vec3 origin, direction;
        camera.ray({static_cast<float>(x) + 0.5f + shift, static_cast<float>(y) + 0.5f}, origin, direction);
        return -10 / dot(vec3(4, 0, -1), direction) * direction.z;
      };
      // Vertices sit on a lattice of 1/1024 px.
      EXPECT_NEAR(begin(t, p)[0].z, planeZ(0), planeZ(0x1p-10f) - planeZ(0) + 1e-6f * planeZ(0));
      ++seenPixels;
    }
  EXPECT_GT(seenPixels, 100);
}

TEST(Depth, MatteHidesWhatIsBehindAndStaysVisible) {
  World w;
  Attributes matte;
  matte.matte = true;
  w.add(), w.add(matte);
  w.freeze();
  const auto back = raster(w, makeGrid(0, 1, 2, 2, rectangle(0, 0, 16, 16, 2)));
  const auto front = raster(w, makeGrid(1, 2, 2, 2, rectangle(0, 0, 16, 16, 1)));
  EXPECT_TRUE(front->matte);
  EXPECT_FALSE(back->matte);
  const DeepTile t = hide(w, SamplePattern(2, 2, true, 1), kRect, {back, front});
  ASSERT_EQ(t.batches.size(), 1U);
  EXPECT_TRUE(w.scene.groups[static_cast<size_t>(t.batches[0].group())].attributes->matte);
}

TEST(Hider, KnowsWhatIsHidden) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern pattern(2, 2, true, 1);
  Hider h(w.scene, Camera(w.scene.options), pattern, kRect);
  const auto box = [](float x0, float y0, float x1, float y1) { return Bound2{{x0, y0}, {x1, y1}}; };
  EXPECT_FALSE(h.hidden(box(4, 4, 6, 6), 100));
  EXPECT_TRUE(h.hidden(box(40, 4, 60, 6), 1));  // Not in this bucket.
  h.insert(raster(w, makeGrid(0, 1, 4, 4, rectangle(0, 0, 10, 16, 5))));
  EXPECT_TRUE(h.hidden(box(-20, 2, 8, 30), 5.01f));
  EXPECT_FALSE(h.hidden(box(2, 2, 8, 8), 5));
  EXPECT_FALSE(h.hidden(box(2, 2, 12, 8), 6));
  h.insert(raster(w, makeGrid(0, 2, 4, 4, rectangle(9, 0, 16, 16, 5)), false));
  EXPECT_FALSE(h.hidden(box(11, 2, 12, 8), 6));
}

}  // namespace
}  // namespace tomales::test
