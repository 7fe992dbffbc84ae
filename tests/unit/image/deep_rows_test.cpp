#include <gtest/gtest.h>

#include "tests/unit/image/frames.h"

namespace tomales {
namespace {

constexpr size_t kWidth = 6;  // R G B A Z ZBack

struct Flat {
  vec3 color{0.0f};
  float alpha = 0;
};

/// "Over" of the samples of one pixel, nearest first.
Flat flatten(const float* samples, uint32_t count) {
  Flat out;
  for (uint32_t i = 0; i < count; ++i, samples += kWidth) {
    out.color += (1 - out.alpha) * vec3(samples[0], samples[1], samples[2]);
    out.alpha += (1 - out.alpha) * samples[3];
  }
  return out;
}

/// Opacity before depth z.
float alphaBefore(const float* samples, uint32_t count, float z) {
  float clear = 1;
  for (uint32_t i = 0; i < count && samples[5] < z; ++i, samples += kWidth) clear *= 1 - samples[3];
  return 1 - clear;
}

std::vector<Layer> stack(int layers, float opacity, float gap) {
  std::vector<Layer> out;
  for (int i = 0; i < layers; ++i) {
    const uint64_t samples = (hash32(static_cast<uint32_t>(i)) | 1) & 0xffff;
    out.push_back({opacity * vec3(0.3f, 0.1f * static_cast<float>(i), 1), vec3(opacity),
                   2 + gap * static_cast<float>(i), samples});
  }
  return out;
}

class DeepRowsTest : public testing::TestWithParam<const char*> {};

TEST_P(DeepRowsTest, FlattenedAreTheFilteredPicture) {
  for (const float opacity : {0.01f, 0.3f, 1.0f}) {
    const DeepFrame frame = frameOf(stack(12, opacity, 0.25f), 4, 2, 16);
    const Options options = filtered(GetParam(), 3);
    const SampleOffsets samples = jittered(16, 8);
    FrameFilter filter(frame, options, samples);
    const Image flat = filter.rows(0, 4);
    const DeepRows deep = filter.deepRows(0, 4, {});
    const float* at = deep.values.data();
    for (size_t p = 0; p < deep.counts.size(); at += kWidth * deep.counts[p], ++p) {
      const Flat is = flatten(at, deep.counts[p]);
      const float* should = flat.pixels.data() + 5 * p;
      EXPECT_NEAR(is.alpha, should[3], 1e-5f) << opacity;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(is.color[k], should[k], 2e-5f) << opacity;
      for (uint32_t i = 1; i < deep.counts[p]; ++i) EXPECT_GE(at[kWidth * i + 4], at[kWidth * (i - 1) + 5]);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Filters, DeepRowsTest, testing::Values("box", "gaussian", "triangle", "blackman-harris"));

TEST(DeepRows, MergingMovesOpacityByNoMoreThanItMay) {
  const DeepFrame frame = frameOf(stack(40, 0.004f, 0.1f), 1, 0, 16);
  const Options options = filtered("box", 1);
  const SampleOffsets samples = jittered(16, 8);
  FrameFilter filter(frame, options, samples);
  const DeepRows all = filter.deepRows(0, 1, {0, 0}), merged = filter.deepRows(0, 1, {0, 0.01f});
  EXPECT_EQ(all.counts[0], 40u);
  EXPECT_LT(merged.counts[0], 15u);
  for (float z = 1.95f; z < 7; z += 0.1f)
    EXPECT_NEAR(alphaBefore(merged.values.data(), merged.counts[0], z),
                alphaBefore(all.values.data(), all.counts[0], z), 0.0101f);
}

TEST(DeepRows, WhatLiesAtOneDepthIsOneSample) {
  const DeepFrame frame =
      frameOf({{vec3(1.0f), vec3(1.0f), 5, 0x00ff}, {vec3(0.5f), vec3(1.0f), 5.001f, 0xff00}}, 1, 0, 16);
  const Options options = filtered("box", 1);
  const SampleOffsets samples = jittered(16, 8);
  const DeepRows deep = FrameFilter(frame, options, samples).deepRows(0, 1, {});
  ASSERT_EQ(deep.counts[0], 1u);
  EXPECT_FLOAT_EQ(deep.values[0], 0.75f);
  EXPECT_EQ(deep.values[4], 5);
  EXPECT_EQ(deep.values[5], 5.001f);
}

TEST(DeepRows, AHoldoutLeavesNoSampleAndHidesWhatLiesBehind) {
  const DeepFrame frame =
      frameOf({{vec3(0.7f), vec3(1.0f), 1, 0b01, true}, {vec3(0.5f), vec3(1.0f), 2, 0b11}}, 1, 0, 2);
  const Options options = filtered("box", 1);
  const SampleOffsets samples = jittered(2, 2);
  const DeepRows deep = FrameFilter(frame, options, samples).deepRows(0, 1, {});
  ASSERT_EQ(deep.counts[0], 1u);
  EXPECT_FLOAT_EQ(deep.values[0], 0.25f);
  EXPECT_FLOAT_EQ(deep.values[3], 0.5f);
}

TEST(DeepRows, OpacityMapsKeepThreeOpacities) {
  const DeepFrame frame = frameOf({{vec3(0.0f), vec3(0.7f, 0.4f, 0.1f), 1, 1}}, 1, 0, 1);
  const Options options = filtered("box", 1);
  const SampleOffsets samples = jittered(1, 1);
  DeepMerge merge;
  merge.opacityOnly = true;
  const DeepRows deep = FrameFilter(frame, options, samples).deepRows(0, 1, merge);
  EXPECT_EQ(deep.values, (std::vector<float>{0.7f, 0.4f, 0.1f, 1, 1}));
}

}  // namespace
}  // namespace tomales
