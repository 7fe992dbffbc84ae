#include "reyes/hide/pixel_layers.h"

#include <gtest/gtest.h>

#include <bit>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

bool nearer(const CellCoverage& a, const CellCoverage& b) { return a.d != b.d ? a.d < b.d : a.cell < b.cell; }

/// CellCoverages of 70 samples at random depths, few enough different ones that some are equal.
struct Crossing {
  std::vector<std::vector<float>> depths;
  std::vector<CellCoverage> coverages;
  explicit Crossing(uint32_t seed) {
    for (uint32_t cell = 0; cell < 40; ++cell) {
      const uint32_t word = cell % 5 == 0;
      const uint64_t lanes = uint64_t{hashCombine(seed, cell, 1U)} << 32 | hashCombine(seed, cell, 2U);
      const uint64_t samples = word ? lanes & 0x3f : lanes;
      if (samples == 0) continue;
      std::vector<float>& d = depths.emplace_back(64, 1e3f);
      float nearest = kInfinity, farthest = -kInfinity;
      for (uint64_t left = samples; left; left &= left - 1) {
        const int k = std::countr_zero(left);
        d[static_cast<size_t>(k)] = static_cast<float>(hashCombine(seed, cell, 3U, static_cast<uint32_t>(k)) % 50);
        nearest = std::min(nearest, d[static_cast<size_t>(k)]);
        farthest = std::max(farthest, d[static_cast<size_t>(k)]);
      }
      coverages.push_back({cell, word, samples, nearest, nullptr, seed % 2 ? farthest : kInfinity});
    }
    for (size_t i = 0; i < coverages.size(); ++i) coverages[i].depths = depths[i].data();
    std::sort(coverages.begin(), coverages.end(), nearer);
  }
};

/// Depth of a sample, a bit of the mask of a coverage.
float depthAt(const CellCoverage& s, const std::vector<CellCoverage>& given, uint64_t bit) {
  const auto it = std::find_if(given.begin(), given.end(), [&](const CellCoverage& g) { return g.cell == s.cell; });
  return it->depths[std::countr_zero(bit)];
}

TEST(PixelLayers, EverySampleSeesEachOfItsLayersOnceAndNearestFirst) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const Crossing given(seed);
    std::vector<CellCoverage> ordered = given.coverages;
    PixelLayers layers;
    layers.order(ordered, nearer);
    std::vector<float> last(128, -1);
    std::vector<uint64_t> seen(40);
    for (const CellCoverage& s : ordered) {
      EXPECT_EQ(seen[s.cell] & s.samples, 0U);
      seen[s.cell] |= s.samples;
      for (uint64_t left = s.samples; left; left &= left - 1) {
        const uint64_t bit = left & (~left + 1);
        float& before = last[s.word * 64 + static_cast<uint32_t>(std::countr_zero(left))];
        const float d = depthAt(s, given.coverages, bit);
        EXPECT_LE(before, d);
        EXPECT_LE(s.d, d);
        before = d;
      }
    }
    for (const CellCoverage& s : given.coverages) EXPECT_EQ(seen[s.cell], s.samples);
  }
}

TEST(PixelLayers, WhatIsInOrderStaysWhole) {
  const float near[2] = {1, 2}, far[2] = {3, 4};
  std::vector<CellCoverage> coverages{{7, 0, 0b11, 1, near}, {8, 0, 0b11, 3, far}};
  PixelLayers().order(coverages, nearer);
  ASSERT_EQ(coverages.size(), 2U);
  EXPECT_EQ(coverages[0].samples, 0b11U);
}

}  // namespace
}  // namespace tomales
