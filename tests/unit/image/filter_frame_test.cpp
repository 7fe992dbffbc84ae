#include <gtest/gtest.h>

#include "reyes/base/parallel.h"
#include "tests/unit/image/frames.h"

namespace tomales {
namespace {

TEST(FilterFrame, AConstantFrameStaysConstantUnderEveryFilter) {
  const vec3 color(0.25f, 0.5f, 4.0f);
  for (const char* name : {"box", "triangle", "gaussian", "catmull-rom", "separable-catmull-rom", "sinc", "mitchell",
                           "blackman-harris", "lanczos", "disk"}) {
    const DeepFrame frame = frameOf({{color, vec3(1.0f), 2, 0xffff}}, 5, 2, 16);
    const Image image = filterFrame(frame, filtered(name, 4), jittered(16, 8));
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(x, y)[c], color[c], 2e-5f * color[c]) << name;
        EXPECT_NEAR(image.at(x, y)[3], 1, 2e-5f) << name;
        EXPECT_EQ(image.at(x, y)[4], 2) << name;
      }
  }
}

TEST(FilterFrame, HalfCoverageUnderABoxIsHalfTheColourAndHalfTheAlpha) {
  const DeepFrame frame = frameOf({{vec3(0.5f, 1, 2), vec3(1.0f), 3, 0b0011}}, 2, 0, 4);
  const Image image = filterFrame(frame, filtered("box", 1), jittered(4, 4));
  EXPECT_FLOAT_EQ(image.at(1, 1)[0], 0.25f);
  EXPECT_FLOAT_EQ(image.at(1, 1)[2], 1.0f);
  EXPECT_FLOAT_EQ(image.at(1, 1)[3], 0.5f);
}

TEST(FilterFrame, LayersOfOneOpacityCompositeToOneMinusClearnessToTheirNumber) {
  for (const float a : {0.1f, 0.3f, 0.5f})
    for (int n = 1; n <= 6; ++n) {
      const std::vector<Layer> layers(static_cast<size_t>(n), {vec3(a), vec3(a), 1, 0xf});
      const Image image = filterFrame(frameOf(layers, 1, 0, 4), filtered("box", 1), jittered(4, 4));
      const float expected = 1 - std::pow(1 - a, static_cast<float>(n));
      EXPECT_NEAR(image.at(0, 0)[3], expected, 1e-5f);
      EXPECT_NEAR(image.at(0, 0)[0], expected, 1e-5f);
    }
}

TEST(FilterFrame, OpacityOfEachChannelHidesItsOwnChannel) {
  const DeepFrame frame = frameOf({{vec3(0.0f), vec3(1, 0.5f, 0), 1, 1}, {vec3(1.0f), vec3(1.0f), 2, 1}}, 1, 0, 1);
  const Image image = filterFrame(frame, filtered("box", 1), jittered(1, 1));
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 0);
  EXPECT_FLOAT_EQ(image.at(0, 0)[1], 0.5f);
  EXPECT_FLOAT_EQ(image.at(0, 0)[2], 1);
}

TEST(FilterFrame, WhatLiesBehindSomethingOpaqueIsNotSeen) {
  const DeepFrame frame = frameOf({{vec3(0.5f), vec3(1.0f), 1, 1}, {vec3(100.0f), vec3(1.0f), 2, 3}}, 1, 0, 2);
  const Image image = filterFrame(frame, filtered("box", 1), jittered(2, 1));
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 0.5f * (0.5f + 100.0f));
}

TEST(FilterFrame, AMatteObjectHidesAndLeavesNeitherColourNorAlpha) {
  const DeepFrame frame =
      frameOf({{vec3(0.7f), vec3(1.0f), 1, 0b01, true}, {vec3(0.5f), vec3(1.0f), 2, 0b11}}, 1, 0, 2);
  const Image image = filterFrame(frame, filtered("box", 1), jittered(2, 1));
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 0.25f);
  EXPECT_FLOAT_EQ(image.at(0, 0)[3], 0.5f);
}

TEST(FilterFrame, SamplesBeyondSixtyFourAreKeptApart) {
  DeepFrame frame =
      frameOf({{vec3(1.0f), vec3(0.5f), 1, ~uint64_t{0}}, {vec3(3.0f), vec3(1.0f), 2, ~uint64_t{0}}}, 1, 0, 128);
  frame.tiles[0].fragments[1].word = 1;
  const Image image = filterFrame(frame, filtered("box", 1), jittered(128, 2));
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 2);
  EXPECT_FLOAT_EQ(image.at(0, 0)[3], 0.75f);
}

TEST(FilterFrame, LayersOfSamplesBeyondSixtyFourAreComposited) {
  DeepFrame frame = frameOf({{vec3(1.0f), vec3(0.5f), 1, 0xf0}, {vec3(3.0f), vec3(1.0f), 2, 0xff}}, 1, 0, 128);
  for (Fragment& f : frame.tiles[0].fragments) f.word = 1;
  const Image image = filterFrame(frame, filtered("box", 1), jittered(128, 2));
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], (4 * (1 + 0.5f * 3) + 4 * 3) / 128);
  EXPECT_FLOAT_EQ(image.at(0, 0)[3], 8.0f / 128);
}

TEST(FilterFrame, SmoothFacetsAreBilinearInTheirFourPoints) {
  DeepFrame frame = frameOf({{vec3(0.0f), vec3(1.0f), 1, 1}}, 1, 0, 1);
  DeepTile& tile = frame.tiles[0];
  tile.shaded[0].resize(4);
  for (int i = 0; i < 4; ++i) {
    tile.facets[0].point[i] = i;
    tile.shaded[0].Ci[0][static_cast<size_t>(i)] = static_cast<float>(i);  // u + 2 v
    for (auto& channel : tile.shaded[0].Oi) channel[static_cast<size_t>(i)] = 1;
  }
  tile.fragments[0].u = 51;
  tile.fragments[0].v = 102;
  const Image image = filterFrame(frame, filtered("box", 1), jittered(1, 1));
  EXPECT_NEAR(image.at(0, 0)[0], 51.5f / 256 + 2 * 102.5f / 256, 1e-6f);
}

TEST(FilterFrame, EmptyPixelsAreBlackAndInfinitelyFar) {
  const Image image = filterFrame(frameOf({}, 2, 1, 4), filtered("gaussian", 2), jittered(4, 4));
  EXPECT_EQ(image.at(0, 0)[0], 0);
  EXPECT_EQ(image.at(0, 0)[3], 0);
  EXPECT_EQ(image.at(0, 0)[4], kInfinity);
}

TEST(FilterFrame, TilesThatAnInterruptionLeftEmptyAreBackground) {
  DeepFrame frame = frameOf({{vec3(1.0f), vec3(1.0f), 1, 1}}, 2, 0, 1);
  frame.tiles[0] = DeepTile{};
  EXPECT_EQ(filterFrame(frame, filtered("box", 1), jittered(1, 1)).at(1, 1)[3], 0);
}

/// Options with one Display of float channel "x"; `filter` of Channel.
Options showing(const std::string& filter, float fill = 0, ValueType type = ValueType::Float) {
  Options o = filtered("box", 1);
  Param f, value;
  f.name = "filter";
  f.type = ValueType::String;
  f.strings = {filter};
  value.name = "fill";
  value.floats = {fill};
  o.channels["x"] = {"x", type, {f, value}, {}};
  o.displays.push_back({"a.exr", "openexr", "x", {}, {}});
  return o;
}

/// Two surfaces side by side in every pixel, at depths 1 and 2, on a quarter and a half of the samples.
DeepFrame twoSurfaces(float near, float far) {
  DeepFrame frame = frameOf({{vec3(0.2f), vec3(1.0f), 1, 0b0001}, {vec3(0.4f), vec3(1.0f), 2, 0b0110}}, 1, 0, 4);
  frame.tiles[0].shaded[0].variables = {{near, far}};
  return frame;
}

TEST(FilterFrame, AVariableIsFilteredOrTakenOfOneSurface) {
  const DeepFrame frame = twoSurfaces(8, 4);
  const SampleOffsets samples = jittered(4, 4);
  EXPECT_FLOAT_EQ(filterFrame(frame, showing("box"), samples).at(0, 0)[5], (8 + 2 * 4) / 4.0f);
  EXPECT_FLOAT_EQ(filterFrame(frame, showing("box", 16), samples).at(0, 0)[5], (8 + 2 * 4 + 16) / 4.0f);
  EXPECT_EQ(filterFrame(frame, showing("zmin"), samples).at(0, 0)[5], 8);
  EXPECT_EQ(filterFrame(frame, showing("zmax"), samples).at(0, 0)[5], 4);
  EXPECT_EQ(filterFrame(frame, showing("min"), samples).at(0, 0)[5], 4);
  EXPECT_EQ(filterFrame(frame, showing("max"), samples).at(0, 0)[5], 8);
  EXPECT_FLOAT_EQ(filterFrame(frame, showing("average"), samples).at(0, 0)[5], (8 + 2 * 4) / 3.0f);
}

TEST(FilterFrame, EmptyPixelsHoldTheFill) {
  DeepFrame frame = frameOf({}, 1, 0, 4);
  for (const char* filter : {"box", "zmin", "average"})
    EXPECT_EQ(filterFrame(frame, showing(filter, 3), jittered(4, 4)).at(0, 0)[5], 3) << filter;
}

TEST(FilterFrame, ColoursAreCompositedAndOtherVariablesAreOfTheNearestSurface) {
  DeepFrame frame = frameOf({{vec3(0.2f), vec3(0.25f), 1, 1}, {vec3(0.4f), vec3(1.0f), 2, 1}}, 1, 0, 1);
  frame.tiles[0].shaded[0].variables.assign(3, {1, 10});
  const SampleOffsets samples = jittered(1, 1);
  EXPECT_FLOAT_EQ(filterFrame(frame, showing("box", 0, ValueType::Color), samples).at(0, 0)[6], 1 + 0.75f * 10);
  EXPECT_EQ(filterFrame(frame, showing("box", 0, ValueType::Normal), samples).at(0, 0)[6], 1);
}

TEST(FilterFrame, AMatteObjectLeavesNoVariable) {
  DeepFrame frame = frameOf({{vec3(0.7f), vec3(1.0f), 1, 1, true}}, 1, 0, 1);
  frame.tiles[0].shaded[0].variables.assign(3, {9});
  EXPECT_EQ(filterFrame(frame, showing("box", 0, ValueType::Color), jittered(1, 1)).at(0, 0)[5], 0);
  EXPECT_EQ(filterFrame(frame, showing("zmin", 2), jittered(1, 1)).at(0, 0)[5], 2);
}

TEST(FilterFrame, DepthFiltersLookAtWhatIsOpaque) {
  const std::vector<Layer> layers{{vec3(0.1f), vec3(0.5f), 1, 0b01},
                                  {vec3(0.2f), vec3(1.0f), 2, 0b01},
                                  {vec3(0.2f), vec3(1.0f), 3, 0b11},
                                  {vec3(0.2f), vec3(1.0f), 5, 0b11}};
  const auto depth = [&](DepthFilter filter, float threshold) {
    Options o = filtered("box", 1);
    o.depthFilter = filter;
    o.depthThreshold = vec3(threshold);
    return filterFrame(frameOf(layers, 1, 0, 2), o, jittered(2, 2)).at(0, 0)[4];
  };
  EXPECT_EQ(depth(DepthFilter::Min, 1), 2);
  EXPECT_EQ(depth(DepthFilter::Min, 0.5f), 1);
  EXPECT_EQ(depth(DepthFilter::Max, 1), 3);
  EXPECT_EQ(depth(DepthFilter::Average, 1), 2.5f);
  EXPECT_EQ(depth(DepthFilter::Midpoint, 1), 2.5f);  // of 2 and 3; the other sample's is 4
}

TEST(FilterFrame, TheMidpointOfASingleSurfaceIsHalfWayToTheFarPlane) {
  Options o = filtered("box", 1);
  o.depthFilter = DepthFilter::Midpoint;
  o.farClip = 100;
  EXPECT_EQ(filterFrame(frameOf({{vec3(0.1f), vec3(1.0f), 2, 1}}, 1, 0, 1), o, jittered(1, 1)).at(0, 0)[4], 51);
}

TEST(FilterFrame, BandsOfRowsAreThePicture) {
  const DeepFrame frame =
      frameOf({{vec3(0.3f), vec3(0.5f), 1, 0x5a5a}, {vec3(0.9f), vec3(1.0f), 2, 0x0ff0}}, 20, 2, 16);
  const Options options = filtered("mitchell", 4);
  const SampleOffsets samples = jittered(16, 8);
  FrameFilter filter(frame, options, samples);
  std::vector<float> bands = filter.rows(0, 7).pixels;
  const Image rest = filter.rows(7, 20);
  EXPECT_EQ(rest.originY, 7);
  bands.insert(bands.end(), rest.pixels.begin(), rest.pixels.end());
  EXPECT_EQ(bands, filterFrame(frame, options, samples).pixels);
}

/// The same in tiles of `size` x `size` pixels.
DeepFrame cut(DeepFrame frame, int size) {
  const DeepTile whole = frame.tiles[0];
  frame.bucketWidth = frame.bucketHeight = size;
  frame.columns = (frame.padded.width() + size - 1) / size;
  frame.rows = (frame.padded.height() + size - 1) / size;
  frame.holdAll();
  for (size_t i = 0; i < frame.tileCount(); ++i) {
    DeepTile& tile = frame.tiles[i] = whole;
    tile.rect = frame.rectOf(i);
    tile.pixels.clear();
    for (int y = tile.rect.y0; y < tile.rect.y1; ++y)
      for (int x = tile.rect.x0; x < tile.rect.x1; ++x) tile.pixels.push_back(whole.pixel(x, y));
  }
  return frame;
}

TEST(FilterFrame, TilesThatAreBroughtAndGoAreTheSameAsThoseOfTheFrame) {
  const Options options = filtered("gaussian", 4);
  const SampleOffsets samples = jittered(16, 8);
  DeepFrame frame = cut(
      frameOf({{vec3(0.3f, 0.2f, 0.9f), vec3(0.4f), 1, 0x0ff3}, {vec3(1.0f), vec3(1.0f), 2, 0x3f0f}}, 20, 2, 16), 5);
  const Image whole = filterFrame(frame, options, samples);
  const std::vector<DeepTile> tiles = std::move(frame.tiles);
  frame.hold(0, 0);
  FrameFilter filter(frame, options, samples);
  size_t next = 0;
  for (int y = 0; y < 20; y += 4) {
    const auto end = static_cast<size_t>((frame.rowOf(y + 4 + 2 - 1) + 1) * frame.columns);
    for (; next < end; ++next) filter.resolve(next, tiles[next]);
    const Image band = filter.rows(y, y + 4);
    EXPECT_TRUE(std::equal(band.pixels.begin(), band.pixels.end(), whole.at(0, y))) << y;
  }
  EXPECT_EQ(next, tiles.size());
}

TEST(FilterFrame, ThreadsLeaveNoTrace) {
  const DeepFrame frame =
      frameOf({{vec3(0.3f), vec3(0.5f), 1, 0x5a5a}, {vec3(0.9f), vec3(1.0f), 2, 0x0ff0}}, 64, 2, 16);
  const Image all = filterFrame(frame, filtered("mitchell", 4), jittered(16, 8));
  const ThreadLimit one(1);
  EXPECT_EQ(all.pixels, filterFrame(frame, filtered("mitchell", 4), jittered(16, 8)).pixels);
}

}  // namespace
}  // namespace tomales
