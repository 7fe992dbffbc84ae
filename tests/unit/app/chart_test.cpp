#include <gtest/gtest.h>

#include <fstream>

#include "reyes/app/chart/html.h"
#include "reyes/app/chart/lab.h"
#include "reyes/app/chart/report.h"
#include "reyes/app/chart/sweeps.h"
#include "reyes/app/settings.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

Image grey(int width, int height, float value) {
  return {width, height, {"R", "G", "B"}, std::vector<float>(static_cast<size_t>(width * height * 3), value),
          0,     0,      width,           height};
}

/// About `value`, off by up to `noise` of it.
Image noisy(float value, float noise, uint32_t seed) {
  Image out = grey(64, 64, value);
  for (uint32_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] *= 1 + noise * (2 * unitFloat(hashCombine(i, seed)) - 1);
  return out;
}

TEST(ChartError, APictureTwiceAsBrightIsWholeWrong) {
  ChartReference reference;
  ASSERT_TRUE(reference.add(grey(4, 4, 0.99f)));
  const ErrorFigures error = reference.errorOf(grey(4, 4, 1.98f));
  EXPECT_NEAR(error.mean, 0.99, 1e-5);
  EXPECT_NEAR(error.p99, 0.99, 1e-5);
  EXPECT_NEAR(error.bias, 1, 1e-5);
  EXPECT_NEAR(error.rms, 1, 1e-5);
}

TEST(ChartError, PixelsThatTheReferenceLeavesBlackDoNotCount) {
  ChartReference reference;
  Image half = grey(4, 4, 1);
  std::fill(half.pixels.begin(), half.pixels.begin() + 24, 0.0f);
  reference.add(half);
  EXPECT_NEAR(reference.errorOf(grey(4, 4, 2)).mean, 1 / 1.01, 1e-5);
}

TEST(ChartError, TheNoiseFloorIsWhatATruePictureIsFoundToBeOff) {
  ChartReference reference;
  for (uint32_t b = 0; b < 8; ++b) reference.add(noisy(1, 0.1f, b));
  const ErrorFigures found = reference.errorOf(grey(64, 64, 1));
  EXPECT_NEAR(reference.noiseFloor() / found.measured, 1, 0.1);
  EXPECT_LT(found.mean, 0.25 * found.measured) << "which is not its own";
}

TEST(ChartError, TheNoiseOfTheReferenceIsTakenOut) {
  ChartReference noisyReference, truth;
  truth.add(grey(64, 64, 1));
  for (uint32_t b = 0; b < 8; ++b) noisyReference.add(noisy(1, 0.3f, b));
  for (const float error : {0.03f, 0.1f, 0.3f}) {
    const Image test = noisy(1, error, 100);
    const double right = truth.errorOf(test).mean;
    const ErrorFigures found = noisyReference.errorOf(test);
    EXPECT_NEAR(found.mean / right, 1, error < 0.1f ? 0.25 : 0.04) << error;
    EXPECT_NEAR(found.rms / truth.errorOf(test).rms, 1, error < 0.1f ? 0.25 : 0.04) << error;
  }
  EXPECT_GT(noisyReference.errorOf(noisy(1, 0.03f, 100)).measured, 2 * truth.errorOf(noisy(1, 0.03f, 100)).mean);
}

TEST(ChartError, TheIntervalOfADifferenceIsNarrowerThanThoseOfTheErrors) {
  ChartReference reference;
  for (uint32_t b = 0; b < 8; ++b) reference.add(noisy(1, 0.3f, b));
  const ErrorFigures worse = reference.errorOf(noisy(1, 0.12f, 100)), better = reference.errorOf(noisy(1, 0.1f, 101));
  const ErrorDifference d = worse - better;
  EXPECT_NEAR(d.mean, 0.01, 0.002);
  EXPECT_GT(d.mean, d.confidence) << "so that the worse one is told";
  EXPECT_LT(d.confidence, worse.confidence);
}

TEST(ChartError, PixelsThatAreNoNumbersCountAsBlackAndAreToldOf) {
  ChartReference reference;
  reference.add(grey(4, 4, 0.99f));
  reference.add(grey(4, 4, 0.99f));
  Image test = grey(4, 4, 0.99f);
  test.pixels[0] = std::numeric_limits<float>::quiet_NaN();
  test.pixels[4] = kInfinity;
  const ErrorFigures error = reference.errorOf(test);
  EXPECT_EQ(error.notFinite, 2);
  EXPECT_NEAR(error.mean, 0.99 * 2 / 16, 1e-5);
  EXPECT_NEAR(error.bias, -2.0 / 16, 1e-5);
  EXPECT_NEAR(error.confidence, 0, 1e-5);
  EXPECT_EQ(notFiniteNote(error), ", 2 pixels not finite");
  EXPECT_EQ(reference.errorMap(test, 0.1f).pixels[1], 1) << "green";
}

TEST(ChartError, PixelsThatTheReferenceDoesNotKnowDoNotCount) {
  Image broken = grey(4, 4, 1);
  broken.pixels[0] = kInfinity;
  ChartReference reference;
  reference.add(broken);
  reference.add(grey(4, 4, 1));
  EXPECT_EQ(reference.noiseFloor(), 0);
  const ErrorFigures error = reference.errorOf(grey(4, 4, 1));
  EXPECT_EQ(error.notFinite, 1);
  EXPECT_EQ(error.mean, 0);
  ChartReference dark;
  dark.add(grey(4, 4, std::numeric_limits<float>::quiet_NaN()));
  EXPECT_TRUE(dark.isBlack());
}

TEST(ChartError, BatchesOfAnotherSizeAreRefused) {
  ChartReference reference;
  EXPECT_TRUE(reference.add(grey(4, 4, 1)));
  EXPECT_FALSE(reference.add(grey(4, 5, 1)));
}

TEST(ChartReport, ThePointsThatNothingBeatsAreMarked) {
  ChartReport report;
  report.curves = {"a"};
  const auto point = [](double cpu, double error) {
    ChartPoint p{};
    p.run.cpu_s = cpu;
    p.error.mean = error;
    return p;
  };
  report.points = {point(1, 0.1), point(2, 0.2), point(4, 0.025)};
  markBest(report);
  EXPECT_TRUE(report.points[0].bestInTime);
  EXPECT_FALSE(report.points[1].bestInTime);
  EXPECT_TRUE(report.points[2].bestInTime);
  report.points.erase(report.points.begin() + 1);
  EXPECT_NEAR(*secondsToReach(report, 0, 0.05), 2, 1e-9) << "halfway on logarithmic axes";
  EXPECT_FALSE(secondsToReach(report, 0, 0.01));
}

TEST(ChartReport, ACurveOfOneErrorIsFlat) {
  ChartReport report;
  report.curves = {"even", "steep", "alone"};
  const auto add = [&](size_t curve, double error) {
    ChartPoint p{};
    p.curve = curve;
    p.error.mean = error;
    report.points.push_back(p);
  };
  add(0, 0.1);
  add(0, 0.1);
  add(1, 0.1);
  add(1, 0.05);
  add(2, 0.1);
  EXPECT_TRUE(isFlat(report, 0));
  EXPECT_FALSE(isFlat(report, 1));
  EXPECT_FALSE(isFlat(report, 2)) << "one point says nothing";
}

TEST(ChartSweep, EverySweepHasAReferenceAndCurvesWithSettings) {
  const std::string names = chartSweepNames();
  for (size_t begin = 0; begin < names.size();) {
    const size_t end = std::min(names.find(", ", begin), names.size());
    const auto sweep = chartSweep(names.substr(begin, end - begin));
    ASSERT_TRUE(sweep) << names.substr(begin, end - begin);
    EXPECT_FALSE(sweep->reference.empty());
    for (const ChartCurve& curve : sweep->curves) EXPECT_GE(curve.settings.size(), 4u) << sweep->name;
    begin = end + 2;
  }
  EXPECT_FALSE(chartSweep("nothing"));
}

TEST(ChartLab, AChangedTextureChangesTheSceneThatNamesIt) {
  const std::string folder = testing::TempDir();
  const auto write = [&](const std::string& name, const std::string& text) { std::ofstream(folder + name) << text; };
  write("chart_scene.rib", "ReadArchive \"chart_part.rib\"\n");
  write("chart_part.rib", "Surface \"x\" \"string map\" \"chart_map.tif\"\n");
  write("chart_map.tif", "before");
  const uint64_t before = contentsOf({folder + "chart_scene.rib"});
  EXPECT_EQ(before, contentsOf({folder + "chart_scene.rib"}));
  write("chart_map.tif", "after");
  EXPECT_NE(before, contentsOf({folder + "chart_scene.rib"}));
}

TEST(ChartPlot, NumbersAreShort) {
  EXPECT_EQ(shortNumber(0.0123456), "0.0123");
  EXPECT_EQ(shortNumber(1234.5), "1234");
  EXPECT_EQ(shortNumber(0), "0");
  EXPECT_EQ(escapeXml("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
}

TEST(Settings, TimesHaveUnits) {
  EXPECT_EQ(parseSeconds("90"), 90);
  EXPECT_EQ(parseSeconds("10m"), 600);
  EXPECT_EQ(parseSeconds("2h"), 7200);
  EXPECT_FALSE(parseSeconds("0"));
  EXPECT_FALSE(parseSeconds("soon"));
}

}  // namespace
}  // namespace tomales
