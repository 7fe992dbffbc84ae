// The layers of relight, as its page gets them.
#include "reyes/app/relight/layers.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace tomales {
namespace {

struct Block {
  uint32_t layer, x, y, width, height, version, serial, step;
  std::vector<vec3> colors;
};

std::vector<Block> blocksOf(const std::string& bytes) {
  std::vector<Block> out;
  for (size_t at = 0; at < bytes.size();) {
    uint32_t h[kBlockHeader];
    std::memcpy(h, bytes.data() + at, sizeof h);
    at += sizeof h;
    Block b{h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], {}};
    const size_t colors = size_t{(b.width + b.step - 1) / b.step} * ((b.height + b.step - 1) / b.step);
    std::vector<uint16_t> half(3 * colors);
    std::memcpy(half.data(), bytes.data() + at, half.size() * sizeof(uint16_t));
    for (size_t i = 0; i < half.size(); i += 3)
      b.colors.emplace_back(glm::unpackHalf1x16(half[i]), glm::unpackHalf1x16(half[i + 1]),
                            glm::unpackHalf1x16(half[i + 2]));
    at += (half.size() * sizeof(uint16_t) + 3) / 4 * 4;
    out.push_back(std::move(b));
  }
  return out;
}

/// Sets the whole layer, each pixel to its column, row and layer.
void fill(LayerStore& store, const PixelRect& window, size_t layer, uint32_t version) {
  std::vector<vec3> rgb;
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x) rgb.emplace_back(x - window.x0, y - window.y0, layer);
  store.put(layer, window, rgb, version);
}

TEST(Layers, AnUpdateOfEverythingAt1080pFitsIntoThreeMegabytes) {
  const PixelRect window{0, 0, 1920, 1080};
  constexpr size_t kLayers = 8, kMost = 3'000'000;
  LayerStore store(window, kLayers);
  for (size_t layer = 0; layer < kLayers; ++layer) fill(store, window, layer, 1);
  uint64_t after = 0;
  const std::string bytes = store.reducedAfter(after, kMost);
  EXPECT_LE(bytes.size(), kMost);
  EXPECT_GT(bytes.size(), kMost / 2);  // no coarser than it has to be
  const std::vector<Block> blocks = blocksOf(bytes);
  ASSERT_EQ(blocks.size(), kLayers);
  for (const Block& b : blocks) EXPECT_EQ(b.step, blocks.front().step);
  EXPECT_EQ(after, store.newest());
}

TEST(Layers, ASquareHasTheMeanOfItsPixelsAndIsCutOffAtTheEdge) {
  const PixelRect window{10, 20, 15, 23};  // a crop: blocks begin at 0
  LayerStore store(window, 1);
  fill(store, window, 0, 7);
  uint64_t after = 0;
  constexpr size_t kHeader = kBlockHeader * sizeof(uint32_t);
  const std::vector<Block> blocks = blocksOf(store.reducedAfter(after, kHeader + 6 * 2 * 3));
  ASSERT_EQ(blocks.size(), 1U);
  const Block& b = blocks.front();
  ASSERT_EQ(b.step, 2U);
  EXPECT_EQ(b.x, 0U);
  EXPECT_EQ(b.y, 0U);
  EXPECT_EQ(b.version, 7U);
  ASSERT_EQ(b.colors.size(), 6U);
  const vec3 expected[] = {{0.5, 0.5, 0}, {2.5, 0.5, 0}, {4, 0.5, 0}, {0.5, 2, 0}, {2.5, 2, 0}, {4, 2, 0}};
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(b.colors[i], expected[i]) << i;
}

TEST(Layers, WhatWasSetAgainComesOnceAndOnlyNewBlocksCome) {
  const PixelRect window{0, 0, 4, 4};
  LayerStore store(window, 2);
  fill(store, window, 0, 1);
  fill(store, window, 0, 2);
  fill(store, window, 1, 1);
  uint64_t after = 0;
  const std::vector<Block> first = blocksOf(store.reducedAfter(after, 1 << 20));
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].version, 2U);
  EXPECT_EQ(first[1].layer, 1U);
  EXPECT_TRUE(store.reducedAfter(after, 1 << 20).empty());
  fill(store, window, 1, 3);
  const std::vector<Block> next = blocksOf(store.reducedAfter(after, 1 << 20));
  ASSERT_EQ(next.size(), 1U);
  EXPECT_EQ(next[0].version, 3U);
}

TEST(Layers, FullSizeComesInPiecesUpToTheLastBlockThatIsAskedFor) {
  const PixelRect window{0, 0, 64, 1};
  LayerStore store(window, 1);
  for (int x = 0; x < 64; x += 16)
    store.put(0, {x, 0, x + 16, 1}, std::vector<vec3>(16, vec3(x)), static_cast<uint32_t>(x));
  uint64_t after = 0;
  std::vector<uint32_t> seen;
  while (after < 3)
    for (const Block& b : blocksOf(store.blocksAfter(after, 1, 3))) seen.push_back(b.x);
  EXPECT_EQ(seen, (std::vector<uint32_t>{0, 16, 32}));
}

TEST(Layers, NewsThatCameBeforeSomebodyWaitsForItEndsTheWait) {
  const LayerStore store({0, 0, 1, 1}, 1);
  const uint64_t told = store.woken();
  store.wake();
  EXPECT_EQ(store.woken(), told + 1);
  const auto start = std::chrono::steady_clock::now();
  store.wait(store.newest(), told);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));  // without news it takes longer
}

TEST(Layers, WhatHalfFloatsCannotHoldBecomesTheNearestThatTheyCan) {
  const PixelRect window{0, 0, 2, 1};
  LayerStore store(window, 1);
  store.put(0, window, std::vector<vec3>{{1e9, -1e9, NAN}, {0.1, 0, INFINITY}}, 1);
  EXPECT_EQ(store.at(0, 0, 0), vec3(65504, -65504, 0));
  EXPECT_NEAR(store.at(0, 1, 0).x, 0.1, 0.1 * 4.9e-4);
  EXPECT_EQ(store.at(0, 1, 0).z, 65504);
}

TEST(Layers, ACoarsePictureTakesThePlaceOfItsLayerUntilItIsDropped) {
  const PixelRect window{0, 0, 32, 16};
  LayerStore store(window, 1);
  fill(store, window, 0, 1);
  store.putCoarse(0, std::vector<vec3>{{1, 1, 1}, {2, 2, 2}}, 2);
  uint64_t after = 0;
  const std::vector<Block> blocks = blocksOf(store.reducedAfter(after, 1 << 20));
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].step, static_cast<uint32_t>(kCoarseStep));
  EXPECT_EQ(blocks[0].colors, (std::vector<vec3>{{1, 1, 1}, {2, 2, 2}}));
  uint64_t fine = 0;
  EXPECT_TRUE(store.blocksAfter(fine, 1 << 20, store.newest()).empty());
  store.dropCoarse(0);
  uint64_t all = 0;
  EXPECT_TRUE(store.reducedAfter(all, 1 << 20).empty());
}

}  // namespace
}  // namespace tomales
