#include "reyes/app/denoise/filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr int kSize = 48;

/// A ramp over a floor, with a step of albedo in the middle, as two halves with noise of a share of it.
struct TestHalves {
  explicit TestHalves(float noise) {
    in.width = in.height = kSize;
    in.guides.assign(4, Plane(kSize * kSize));
    for (uint32_t i = 0; i < kSize * kSize; ++i) {
      const float x = static_cast<float>(i % kSize) / kSize, y = static_cast<float>(i / kSize) / kSize,
                  albedo = x < 0.5f ? 0.2f : 0.8f;
      for (size_t c = 0; c < 3; ++c) {
        in.guides[c][i] = albedo;
        truth[c].push_back(albedo * (1 + y));
        in.a[c].push_back(truth[c][i] * (1 + noise * deviation(i, 1)));
        in.b[c].push_back(truth[c][i] * (1 + noise * deviation(i, 2)));
      }
      in.guides[3][i] = y;
    }
  }
  /// About a Gaussian of deviation 1.
  static float deviation(uint32_t i, uint32_t half) {
    float sum = 0;
    for (uint32_t k = 0; k < 12; ++k) sum += unitFloat(hashCombine(i, half, k));
    return sum - 6;
  }
  double rms(const std::array<Plane, 3>& color) const {
    double squares = 0, sum = 0;
    for (size_t c = 0; c < 3; ++c)
      for (size_t i = 0; i < truth[c].size(); ++i) {
        squares += std::pow(double{color[c][i]} - truth[c][i], 2);
        sum += truth[c][i];
      }
    return std::sqrt(squares / (3.0 * kSize * kSize)) / (sum / (3.0 * kSize * kSize));
  }
  std::array<Plane, 3> mean() const {
    std::array<Plane, 3> out = in.a;
    for (size_t c = 0; c < 3; ++c)
      for (size_t i = 0; i < out[c].size(); ++i) out[c][i] = 0.5f * (in.a[c][i] + in.b[c][i]);
    return out;
  }

  HalfBuffers in;
  std::array<Plane, 3> truth;
};

TEST(Denoise, MostOfTheNoiseGoesAndTheStatedErrorsAreTheTrueOnes) {
  for (const float noise : {0.1f, 0.3f, 1.0f}) {
    const TestHalves halves(noise);
    const Denoised out = denoise(halves.in);
    EXPECT_LT(halves.rms(out.color), 0.35 * halves.rms(halves.mean())) << noise;
    EXPECT_NEAR(out.before / halves.rms(halves.mean()), 1, 0.05) << noise;
    EXPECT_NEAR(out.after / halves.rms(out.color), 1, 0.2) << noise;
  }
}

TEST(Denoise, WhatGuidesTellIsNotBlurred) {
  const TestHalves halves(0.3f);
  const Denoised out = denoise(halves.in);
  double step = 0, right = 0;
  for (size_t y = 0; y < kSize; ++y) {
    const size_t i = y * kSize + kSize / 2;
    step += out.color[0][i] - out.color[0][i - 1];
    right += halves.truth[0][i] - halves.truth[0][i - 1];
  }
  EXPECT_NEAR(step / right, 1, 0.06);
}

/// Noise is mixed with that of the next pixel, as by a pixel filter.
Plane mixed(const Plane& half, const Plane& truth) {
  Plane out = half;
  for (size_t i = 0; i + 1 < out.size(); ++i)
    out[i] = truth[i] + 0.5f * (half[i] - truth[i] + half[i + 1] - truth[i + 1]);
  return out;
}

TEST(Denoise, WhatIsSmoothedAwayIsStated) {
  for (const bool mixes : {false, true}) {
    TestHalves halves(0);
    for (size_t c = 0; c < 3; ++c)
      for (uint32_t i = 0; i < kSize * kSize; ++i) {
        const auto x = static_cast<float>(i % kSize), y = static_cast<float>(i / kSize);
        halves.truth[c][i] = 1 + 0.3f * std::sin(0.9f * x) * std::sin(0.7f * y);  // no guide tells of it
        halves.in.a[c][i] = halves.truth[c][i] + 0.5f * TestHalves::deviation(i, 1);
        halves.in.b[c][i] = halves.truth[c][i] + 0.5f * TestHalves::deviation(i, 2);
      }
    for (size_t c = 0; mixes && c < 3; ++c) {
      halves.in.a[c] = mixed(halves.in.a[c], halves.truth[c]);
      halves.in.b[c] = mixed(halves.in.b[c], halves.truth[c]);
    }
    const Denoised out = denoise(halves.in);
    EXPECT_GT(halves.rms(out.color), 0.1);
    EXPECT_NEAR(out.after / halves.rms(out.color), 1, 0.1) << mixes;
  }
}

TEST(Denoise, ASmallBrightSpotStays) {
  TestHalves halves(0.3f);
  const size_t spot = 20 * kSize + 12;
  for (size_t c = 0; c < 3; ++c) halves.in.a[c][spot] = halves.in.b[c][spot] = 5;
  const Denoised out = denoise(halves.in);
  for (size_t c = 0; c < 3; ++c) EXPECT_GT(out.color[c][spot], 3);
}

TEST(Denoise, APictureWithoutNoiseStaysAsItIs) {
  const TestHalves halves(0);
  const Denoised out = denoise(halves.in);
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < out.color[c].size(); ++i) EXPECT_NEAR(out.color[c][i], halves.truth[c][i], 1e-5f);
  EXPECT_EQ(out.before, 0);
}

TEST(Denoise, TheHalvesCountAlike) {
  TestHalves halves(0.3f);
  const Denoised out = denoise(halves.in);
  std::swap(halves.in.a, halves.in.b);
  EXPECT_EQ(denoise(halves.in).color, out.color);
}

}  // namespace
}  // namespace tomales
