#include <gtest/gtest.h>

#include <set>

#include "reyes/hide.h"

namespace tomales {
namespace {

TEST(SamplePattern, EveryStratumOfEveryPatternHoldsOneSample) {
  for (const auto& [xs, ys] : {std::pair{1, 1}, {2, 2}, {3, 5}, {4, 4}, {7, 3}, {8, 8}, {16, 16}}) {
    const SamplePattern p(xs, ys, true, 7);
    ASSERT_EQ(p.count(), xs * ys);
    for (int k = 0; k < 256; ++k) {
      std::set<std::pair<int, int>> strata;
      std::set<int> moments;
      for (int s = 0; s < p.count(); ++s) {
        ASSERT_GE(p.x(k)[s], 0.0f);
        ASSERT_LT(p.x(k)[s], 1.0f);
        ASSERT_GE(p.y(k)[s], 0.0f);
        ASSERT_LT(p.y(k)[s], 1.0f);
        ASSERT_GE(p.time(k)[s], 0.0f);
        ASSERT_LT(p.time(k)[s], 1.0f);
        strata.emplace(static_cast<int>(p.x(k)[s] * static_cast<float>(xs)),
                       static_cast<int>(p.y(k)[s] * static_cast<float>(ys)));
        moments.insert(static_cast<int>(p.time(k)[s] * static_cast<float>(p.count())));
      }
      ASSERT_EQ(strata.size(), static_cast<size_t>(p.count())) << xs << "x" << ys << " pattern " << k;
      ASSERT_EQ(moments.size(), static_cast<size_t>(p.count()));
    }
  }
}

TEST(SamplePattern, LensPointsFillTheUnitDiskEvenlyAndInEveryPattern) {
  const SamplePattern p(4, 4, true, 3);
  double rings[4] = {}, correlation[3] = {};
  for (int k = 0; k < 256; ++k) {
    int quadrants[4] = {};
    for (int s = 0; s < 16; ++s) {
      const float x = p.lensX(k)[s], y = p.lensY(k)[s], r2 = x * x + y * y;
      ASSERT_LE(r2, 1.0f);
      rings[std::min(3, static_cast<int>(r2 * 4))] += 1;
      ++quadrants[(x + y < 0) + 2 * (x - y < 0)];  // The quarters of the square that the disk is bent from.
      correlation[0] += x * (p.x(k)[s] - 0.5);
      correlation[1] += x * (p.time(k)[s] - 0.5);
      correlation[2] += y * (p.y(k)[s] - 0.5);
    }
    for (const int n : quadrants) ASSERT_NEAR(n, 4, 2);
  }
  for (const double n : rings) EXPECT_NEAR(n, 1024, 96);
  // Deviations 1/2 and 1/sqrt(12), over 4096 pairs: four standard deviations of the mean product.
  for (const double c : correlation) EXPECT_NEAR(c / 4096, 0, 4 * 0.5 / std::sqrt(12.0) / 64);
}

TEST(SamplePattern, WithoutJitterSamplesSitAtCellCentres) {
  const SamplePattern p(4, 2, false, 7);
  for (int s = 0; s < 8; ++s) {
    EXPECT_EQ(p.x(99)[s], (static_cast<float>(s % 4) + 0.5f) / 4);
    EXPECT_EQ(p.y(99)[s], (static_cast<float>(s / 4) + 0.5f) / 2);
  }
}

TEST(SamplePattern, ASeedNamesIt) {
  const SamplePattern a(4, 4, true, 1), b(4, 4, true, 1), c(4, 4, true, 2);
  const auto equal = [](const SamplePattern& p, const SamplePattern& q) {
    return std::equal(p.x(0), p.x(255), q.x(0)) && std::equal(p.y(0), p.y(255), q.y(0)) &&
           std::equal(p.time(0), p.time(255), q.time(0));
  };
  EXPECT_TRUE(equal(a, b));
  EXPECT_FALSE(equal(a, c));
  EXPECT_EQ(a.patternOf(-3, 17), b.patternOf(-3, 17));
}

TEST(SamplePattern, PositionsAndTimesHaveTheMomentsOfUniformNumbersAndAreUncorrelated) {
  const SamplePattern p(4, 4, true, 3);
  double sum[3] = {}, square[3] = {}, xt = 0, yt = 0, xy = 0;
  const double n = 256.0 * 16;
  for (int k = 0; k < 256; ++k)
    for (int s = 0; s < 16; ++s) {
      const double v[3] = {p.x(k)[s] - 0.5, p.y(k)[s] - 0.5, p.time(k)[s] - 0.5};
      for (int c = 0; c < 3; ++c) {
        sum[c] += v[c];
        square[c] += v[c] * v[c];
      }
      xt += v[0] * v[2];
      yt += v[1] * v[2];
      xy += v[0] * v[1];
    }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c] / n, 0, 0.004);
    EXPECT_NEAR(square[c] / n, 1.0 / 12, 0.002);
  }
  EXPECT_NEAR(xt / n * 12, 0, 0.06);  // Four standard deviations of a correlation over n pairs.
  EXPECT_NEAR(yt / n * 12, 0, 0.06);
  EXPECT_NEAR(xy / n * 12, 0, 0.06);
}

TEST(SamplePattern, PixelsUseAllPatternsAlike) {
  const SamplePattern p(1, 1, true, 0);
  std::vector<int> uses(256);
  for (int y = 0; y < 128; ++y)
    for (int x = -64; x < 64; ++x) ++uses[static_cast<size_t>(p.patternOf(x, y))];
  for (const int n : uses) EXPECT_NEAR(n, 64, 48);
}

}  // namespace
}  // namespace tomales
