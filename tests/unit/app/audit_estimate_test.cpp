#include "reyes/app/frame/audit_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace tomales {
namespace {

constexpr size_t kPlaces = 300;

/// The absolute value of a draw from the normal distribution has this mean.
const double kMeanOfNormal = std::sqrt(2 / M_PI);

TEST(ErrorEstimate, OfEqualErrorsIsTheirValueWithoutDoubt) {
  const std::vector<AuditedError> places(kPlaces, {0.02f, 0});
  const ErrorEstimate e = estimateError(places);
  EXPECT_NEAR(e.mean, 0.02, 1e-7);
  EXPECT_NEAR(e.low, 0.02, 1e-7);
  EXPECT_NEAR(e.high, 0.02, 1e-7);
  EXPECT_NEAR(e.p99, 0.02, 1e-7);
}

TEST(ErrorEstimate, OfNothingIsZero) {
  const ErrorEstimate e = estimateError({});
  EXPECT_EQ(e.mean, 0);
  EXPECT_EQ(e.high, 0);
}

// Errors and the noise of each estimate are normal: what is seen is wider than the errors alone.
TEST(ErrorEstimate, LeavesOutTheNoiseOfTheAudit) {
  std::mt19937 random(7);
  std::normal_distribution<float> error(0, 0.03f), noise(0, 0.03f);
  std::vector<AuditedError> places;
  for (size_t i = 0; i < 100 * kPlaces; ++i) {
    const float a = noise(random), b = noise(random);
    places.push_back({std::abs(error(random) + 0.5f * (a + b)), 0.5f * std::abs(a - b)});
  }
  const double truth = 0.03 * kMeanOfNormal;
  EXPECT_NEAR(estimateError(places).mean, truth, 0.02 * truth);
  double seen = 0;
  for (const AuditedError& p : places) seen += double{p.error} / static_cast<double>(places.size());
  EXPECT_GT(seen, 1.15 * truth);
}

TEST(ErrorEstimate, IsUnknownBelowTheNoiseWhereNoiseIsAllThatIsSeen) {
  const std::vector<AuditedError> places(kPlaces, {0.01f, 0.02f});
  const ErrorEstimate e = estimateError(places);
  EXPECT_EQ(e.mean, 0);
  EXPECT_FALSE(e.tells());
  EXPECT_NEAR(e.high, 0.02, 1e-7);
}

// 200 audits of errors with a long tail: the share has a standard error of 2.1 %.
TEST(ErrorEstimate, HasAnIntervalThatHoldsTheTruthInNineOfTenCases) {
  std::mt19937 random(11);
  std::exponential_distribution<float> error(1 / 0.02f);
  int held = 0;
  constexpr int kTrials = 200;
  for (int t = 0; t < kTrials; ++t) {
    std::vector<AuditedError> places;
    for (size_t i = 0; i < kPlaces; ++i) places.push_back({error(random), 0});
    const ErrorEstimate e = estimateError(places);
    held += e.low <= 0.02 && 0.02 <= e.high;
  }
  EXPECT_GT(held, 0.83 * kTrials);
  EXPECT_LT(held, 0.96 * kTrials);
}

// Noise that is smaller than each error makes some larger and others smaller, so nothing should be subtracted.
TEST(ErrorEstimate, HasAnIntervalThatHoldsErrorsWhichNoiseDoesNotEnlarge) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.02f);
  std::vector<AuditedError> places;
  for (size_t i = 0; i < 10 * kPlaces; ++i) {
    const float a = noise(random), b = noise(random);
    places.push_back({std::abs(0.04f + 0.5f * (a + b)), 0.5f * std::abs(a - b)});
  }
  const ErrorEstimate e = estimateError(places);
  EXPECT_LT(e.mean, 0.039);
  EXPECT_LT(e.low, e.mean);
  EXPECT_GT(e.high, 0.04);
}

TEST(ErrorEstimate, NamesTheErrorThatOneInAHundredExceeds) {
  std::vector<AuditedError> places(1000, {0.01f, 0});
  for (size_t i = 0; i < 20; ++i) places[50 * i].error = 0.5f;
  EXPECT_NEAR(estimateError(places).p99, 0.5, 1e-6);
  for (size_t i = 5; i < 20; ++i) places[50 * i].error = 0.01f;
  EXPECT_NEAR(estimateError(places).p99, 0.01, 1e-6);
}

/// Blocks whose light is off by draws of this deviation, seen by two estimates with noise of their own.
std::vector<SmoothBlock> drawnBlocks(size_t count, double deviation, double noise, uint32_t seed, double bias = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<SmoothBlock> out;
  for (size_t i = 0; i < count; ++i) {
    const double off = bias + (1 + bias) * deviation * normal(random);
    out.push_back({{off + noise * normal(random), off + noise * normal(random)}});
  }
  return out;
}

TEST(SmudgeEstimate, HasNoNoiseOfTheAuditInIt) {
  for (const double noise : {0.0, 0.01, 0.03}) {
    const SmudgeEstimate e = estimateSmudges(8, drawnBlocks(4000, 0.02, noise, 1));
    EXPECT_NEAR(e.deviation, 0.02, 0.0015) << noise;
    EXPECT_NEAR(e.noise, noise / std::sqrt(2), 0.001);
    EXPECT_LT(e.low, 0.02);
    EXPECT_GT(e.high, 0.02);
  }
}

TEST(SmudgeEstimate, DoesNotCountThatThePictureIsBrighterAsAWhole) {
  EXPECT_NEAR(estimateSmudges(8, drawnBlocks(4000, 0.02, 0.005, 2, 0.5)).deviation, 0.02, 0.0015);
}

TEST(SmudgeEstimate, TellsOnlyABoundWhereNoiseHidesIt) {
  const SmudgeEstimate e = estimateSmudges(8, drawnBlocks(40, 0, 0.05, 3));
  EXPECT_FALSE(e.tells());
  EXPECT_GE(e.high, e.noise);
}

TEST(SmudgeEstimate, KnowsNothingOfFewBlocks) {
  const SmudgeEstimate e = estimateSmudges(8, drawnBlocks(SmudgeEstimate::kFewestBlocks - 1, 0.02, 0, 4));
  EXPECT_FALSE(e.isKnown());
  EXPECT_EQ(e.deviation, 0);
}

TEST(SmudgeEstimate, HoldsTheTruthAsOftenAsItSays) {
  int held = 0;
  for (uint32_t seed = 0; seed < 200; ++seed) {
    const SmudgeEstimate e = estimateSmudges(8, drawnBlocks(37, 0.02, 0.01, 100 + seed));
    held += e.low <= 0.02 && 0.02 <= e.high;
  }
  EXPECT_GT(held, 160) << "the bootstrap of a deviation is a little too sure of few blocks";
  EXPECT_LE(held, 200);
}

}  // namespace
}  // namespace tomales
