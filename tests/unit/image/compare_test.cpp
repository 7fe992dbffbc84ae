#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "reyes/image.h"
#include "reyes/image_compare.h"

namespace tomales {
namespace {

Image grey(int width, int height, const std::vector<float>& values) {
  Image image{width, height, {"R", "G", "B"}, {}, 0, 0, width, height};
  for (const float v : values) image.pixels.insert(image.pixels.end(), 3, v);
  return image;
}
Image noise(int size, float amplitude) {
  std::vector<float> values;
  for (int i = 0; i < size * size; ++i)
    values.push_back(0.5f + amplitude * (unitFloat(hash32(static_cast<uint32_t>(i + 1))) - 0.5f));
  return grey(size, size, values);
}

TEST(Compare, FiguresOfTwoPixelsAreThoseWorkedOutByHand) {
  const Comparison c = compare(grey(2, 1, {0.5f, 0.25f}), grey(2, 1, {0.25f, 0.25f}));
  EXPECT_NEAR(c.rmse, 0.25 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(c.relativeMse, 0.5 * 0.0625 / (0.0625 + 0.01), 1e-9);
  EXPECT_NEAR(c.meanAbsoluteRelativeError, 0.5 * 0.25 / 0.26, 1e-9);
  EXPECT_NEAR(c.maxError, 0.25, 1e-9);
  EXPECT_NEAR(c.psnr_dB, -10 * std::log10(0.5 * 0.0625), 1e-9);
  EXPECT_EQ(c.differentPixels, 1);
}

TEST(Compare, AnImageIsPerfectlyLikeItself) {
  const Comparison c = compare(noise(32, 0.5f), noise(32, 0.5f));
  EXPECT_EQ(c.rmse, 0);
  EXPECT_EQ(c.flip, 0);
  EXPECT_NEAR(c.ssim, 1, 1e-6);
  EXPECT_EQ(c.differentPixels, 0);
  EXPECT_TRUE(std::isinf(c.psnr_dB));
}

// SSIM of two constant images is its luminance term alone.
TEST(Compare, SsimOfConstantsIsTheLuminanceTerm) {
  const std::vector<float> one(400, 1.0f), zero(400, 0.0f);
  EXPECT_NEAR(compare(grey(20, 20, zero), grey(20, 20, one)).ssim, 1e-4 / (1 + 1e-4), 1e-5);
}

TEST(Compare, MoreNoiseIsLessAlike) {
  const Image reference = noise(48, 0.0f);
  const Comparison a = compare(noise(48, 0.1f), reference), b = compare(noise(48, 0.4f), reference);
  EXPECT_LT(a.rmse, b.rmse);
  EXPECT_GT(a.ssim, b.ssim);
  EXPECT_LT(a.flip, b.flip);
}

TEST(Compare, SmudgesAreWhatSmoothBlocksDifferByFromEachOther) {
  std::vector<float> even(16 * 8, 0.5f), halves = even;
  for (size_t i = 0; i < halves.size(); ++i) halves[i] *= i % 16 < 8 ? 1.1f * 2 : 0.9f * 2;
  const Comparison c = compare(grey(16, 8, halves), grey(16, 8, even));
  EXPECT_NEAR(c.smudges[0], 0.1, 1e-6) << "a picture twice as bright has none";
  EXPECT_EQ(c.smudges[1], 0) << "there is no block of 16 x 16";
  EXPECT_EQ(c.specks, 0);
  std::vector<float> edge = even;  // not smooth: nothing counts there
  for (size_t i = 0; i < edge.size(); ++i) edge[i] *= i % 16 < 12 ? 1 : 2;
  EXPECT_EQ(compare(grey(16, 8, halves), grey(16, 8, edge)).smudges[0], 0);
}

TEST(Compare, SmudgesOfASizeShowInBlocksUpToThatSize) {
  std::vector<float> even(64 * 64, 0.5f), halves = even;
  for (size_t i = 0; i < halves.size(); ++i) halves[i] *= i % 32 < 16 ? 1.1f : 0.9f;
  const Comparison c = compare(grey(64, 64, halves), grey(64, 64, even));
  EXPECT_NEAR(c.smudges[0], 0.1, 1e-6);
  EXPECT_NEAR(c.smudges[1], 0.1, 1e-6);
  EXPECT_NEAR(c.smudges[2], 0, 1e-6) << "each block of 32 x 32 holds a bright and a dark half";
}

TEST(Compare, SpecksAreThePixelsThatStandOutOfASmoothBlock) {
  std::vector<float> even(64, 0.5f), speck = even;
  speck[20] = 0.65f;
  speck[40] = 0.55f;
  EXPECT_NEAR(compare(grey(8, 8, speck), grey(8, 8, even)).specks, 1.0 / 64, 1e-9);
}

TEST(Compare, GreenAgainstBlueIsTheLargestPerceptualDifference) {
  Image green = grey(8, 8, std::vector<float>(64, 0.0f)), blue = green;
  for (size_t i = 0; i < green.pixels.size(); i += 3) {
    green.pixels[i + 1] = 1;
    blue.pixels[i + 2] = 1;
  }
  EXPECT_NEAR(compare(green, blue).flip, 1, 1e-4);
}

TEST(Compare, AlphaAndDepthDoNotCountAndChannelsAreFoundByName) {
  const Image plain = grey(1, 1, {0.5f});
  const Image rich{1, 1, {"A", "B", "G", "R", "Z"}, {0.1f, 0.5f, 0.5f, 0.5f, kInfinity}, 0, 0, 1, 1};
  EXPECT_EQ(compare(rich, plain).maxError, 0);
  EXPECT_EQ(compare(plain, rich).maxError, 0);
}

TEST(Compare, DifferenceImageIsTheAbsoluteDifference) {
  const Image d = differenceImage(grey(1, 1, {0.25f}), grey(1, 1, {0.75f}));
  EXPECT_EQ(d.pixels, (std::vector<float>{0.5f, 0.5f, 0.5f}));
}

}  // namespace
}  // namespace tomales
