#include <gtest/gtest.h>

#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

constexpr PixelRect kDepthRect{0, 0, 16, 16};

TEST(Depth, TransparentLayersBecomeFragmentsNearestFirst) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern pattern(4, 4, true, 1);
  Rasters layers;
  for (const float z : {5.0f, 2.0f, 7.0f, 3.0f, 6.0f, 4.0f})
    layers.push_back(raster(w, makeGrid(0, static_cast<uint32_t>(z), 1, 1, rectangle(-1, -1, 17, 20, z)), false));
  const DeepTile t = hide(w, pattern, kDepthRect, layers);
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

TEST(Depth, AnOpaqueSurfaceEndsTheListOfLayers) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern pattern(2, 2, true, 1);
  const auto sheet = [&](float z, bool opaque) {
    return raster(w, makeGrid(0, static_cast<uint32_t>(z), 1, 1, rectangle(-1, -1, 40, 40, z)), opaque);
  };
  const DeepTile t =
      hide(w, pattern, kDepthRect, {sheet(6, false), sheet(2, false), sheet(4, true), sheet(5, true), sheet(3, false)});
  for (const DeepPixel& p : t.pixels) {
    ASSERT_EQ(p.count, 3U);
    for (uint32_t k = 0; k < 3; ++k) ASSERT_EQ(begin(t, p)[k].z, 2 + static_cast<float>(k));
  }
}

TEST(Depth, InterpenetratingSurfacesAreSortedSampleBySample) {
  World w;
  w.add();
  w.add();
  w.freeze();
  ASSERT_NE(w.scene.objects[0].group, w.scene.objects[1].group);
  const auto a = makeGrid(0, 1, 3, 3, [](float u, float v, int) { return at(16 * u, 16 * v, 1 + u); });
  const auto b = makeGrid(1, 2, 5, 2, [](float u, float v, int) { return at(16 * u, 16 * v, 2 - u); });
  const SamplePattern pattern(4, 4, true, 1);
  const DeepTile t = hide(w, pattern, kDepthRect, {raster(w, a), raster(w, b)});
  forSamples(pattern, kDepthRect, [&](int x, int y, int s, vec2 p, float) {
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

/// Transparent sheets that cross each other within pixels, one of them moving, before an opaque one.
TEST(Depth, LayersThatCrossAreInOrderForEverySample) {
  World w;
  w.scene.options.shutterClose = 1;
  for (int k = 0; k < 4; ++k) w.add();
  w.freeze();
  w.scene.objects[2].keyTimes = {0, 1};
  const float slopes[] = {1.3f, -0.9f, 0.4f, 0}, starts[] = {20, 36, 24, 60};
  const auto depthAt = [&](int sheet, const vec2& p, float time) {
    return starts[sheet] + slopes[sheet] * p.x + (sheet == 2 ? 9 * time : 0);
  };
  Rasters sheets;
  for (int k = 0; k < 4; ++k) {
    const Surface sheet = [&, k](float u, float v, int key) {
      const vec2 p = vec2(-2) + 20.0f * vec2(u, v);
      return at(p.x, p.y, depthAt(k, p, static_cast<float>(key)));
    };
    sheets.push_back(raster(w, makeGrid(k, static_cast<uint32_t>(k), 12, 11, sheet, k == 2 ? 2 : 1), k == 3));
  }
  const SamplePattern pattern(9, 9, true, 1);
  const DeepTile t = hide(w, pattern, kDepthRect, sheets);
  int changes = 0;
  forSamples(pattern, kDepthRect, [&](int x, int y, int s, vec2 p, float time) {
    const DeepPixel& pixel = t.pixel(x, y);
    float last = 0;
    for (uint32_t k = 0; k < pixel.count; ++k) {
      const Fragment& f = begin(t, pixel)[k];
      ASSERT_GE(f.z, begin(t, pixel)[k > 0 ? k - 1 : 0].z);
      if (f.word != s / 64 || !(f.samples >> (s % 64) & 1U)) continue;
      int sheet = 0;
      while (groupOf(t, f) != w.scene.objects[static_cast<size_t>(sheet)].group) ++sheet;
      const float z = depthAt(sheet, p, time);
      ASSERT_GE(z, last - 0.01f) << p.x << " " << p.y << " at " << time;
      ASSERT_GE(z, f.z - 0.01f);
      changes += sheet == 0 && last > 0;
      last = z;
    }
    ASSERT_EQ(hits(t, x, y, s), 4);
  });
  EXPECT_GT(changes, 1000);
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
  const DeepTile t = hide(w, centres, kDepthRect, {raster(w, g)});
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
  w.add();
  w.add(matte);
  w.freeze();
  const auto back = raster(w, makeGrid(0, 1, 2, 2, rectangle(0, 0, 16, 16, 2)));
  const auto front = raster(w, makeGrid(1, 2, 2, 2, rectangle(0, 0, 16, 16, 1)));
  EXPECT_TRUE(front->matte);
  EXPECT_FALSE(back->matte);
  const DeepTile t = hide(w, SamplePattern(2, 2, true, 1), kDepthRect, {back, front});
  ASSERT_EQ(t.batches.size(), 1U);
  EXPECT_TRUE(w.scene.groups[static_cast<size_t>(t.batches[0].group())].attributes->matte);
}

TEST(Hider, KnowsWhatIsHidden) {
  World w;
  w.add();
  w.freeze();
  const SamplePattern pattern(2, 2, true, 1);
  Hider h(w.scene, Camera(w.scene.options), pattern, kDepthRect);
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
