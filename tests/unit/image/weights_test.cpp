#include "reyes/image/weights.h"

#include <gtest/gtest.h>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

SampleOffsets offsets(int count) {
  SampleOffsets out{count, {}, [](int x, int y) { return (x + 2 * y) & 3; }};
  for (uint32_t p = 0; p < 4; ++p) {
    auto& positions = out.byPattern.emplace_back();
    for (uint32_t s = 0; s < static_cast<uint32_t>(count); ++s)
      positions.emplace_back(unitFloat(hashCombine(p, s, 0U)), unitFloat(hashCombine(p, s, 1U)));
  }
  return out;
}

TEST(Weights, AllPlacesAtOnceAreThoseAskedForOneByOneBitForBit) {
  const SampleOffsets samples = offsets(80);
  const WeightTable table(PixelFilter("mitchell", 3.5f, 2), samples);
  const PixelRect block{-3, -3, 4, 4};
  const float one[PixelSums::kWide] = {1};
  for (const uint16_t word : {uint16_t{0}, uint16_t{1}}) {
    const uint64_t mask = word == 0 ? 0xf0f3'0000'1234'5679U : 0x0000'0000'0000'a5c3U;
    const Contribution seen{mask, word, 0};
    PixelSums sums(table, block, 1);
    sums.add(0, 0, 2, {{&seen, 1}, one, 0});
    for (int y = -table.reachY; y <= table.reachY; ++y)
      for (int x = -table.reachX; x <= table.reachX; ++x)
        EXPECT_EQ(sums.of(x, y)[0], table.sum(table.cell(2, -x, -y), mask, word));
  }
}

TEST(Weights, WhatIsScatteredIsWhatAPixelWouldGather) {
  const SampleOffsets samples = offsets(16);
  const WeightTable table(PixelFilter("gaussian", 3, 3), samples);
  const PixelRect block{4, 3, 11, 8}, around{3, 2, 12, 9};
  PixelSums scattered(table, block, 3);
  // Each pixel sees two things: one value, and its double under the same weights.
  const auto wide = static_cast<size_t>(scattered.width());
  std::vector<float> values(2 * wide);
  const Contribution twice[2] = {{0xffff, 0, 0}, {0xffff, 0, 0}};
  const auto valueAt = [](int x, int y, int k) {
    return unitFloat(hashCombine(static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(k)));
  };
  for (int y = around.y0; y < around.y1; ++y)
    for (int x = around.x0; x < around.x1; ++x) {
      for (size_t k = 0; k < 3; ++k) {
        values[k] = valueAt(x, y, static_cast<int>(k));
        values[wide + k] = 2 * values[k];
      }
      scattered.add(x, y, samples.patternOf(x, y), {twice, values.data(), wide});
    }
  for (int y = block.y0; y < block.y1; ++y)
    for (int x = block.x0; x < block.x1; ++x) {
      float gathered[3] = {};
      forNeighbours(around, table, samples, x, y, [&](const WeightTable::Cell& cell, const ivec2& pixel) {
        for (const float share : {1.0f, 2.0f})
          for (int k = 0; k < 3; ++k) gathered[k] += table.sum(cell) * (share * valueAt(pixel.x, pixel.y, k));
      });
      for (int k = 0; k < 3; ++k) EXPECT_EQ(scattered.of(x, y)[k], gathered[k]);
    }
}

}  // namespace
}  // namespace tomales
