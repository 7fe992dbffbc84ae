// Motion from the request to the samples: how long each pixel sees what passes it.
#include "tests/unit/frame/hidden_body.h"

namespace tomales {
namespace {
using namespace test;

/// A square of one unit that moves over 64 x 64 pixels, ten of them a unit.
DeepFrame moved(const std::string& motion, const std::string& shutter = "Shutter 0 1") {
  return hideRib(
      "Format 64 64 1 PixelSamples 10 10 PixelFilter \"box\" 1 1 Projection \"orthographic\" ScreenWindow -3.2 3.2 "
      "-3.2 3.2 " +
      shutter + " Translate 0 0 1 WorldBegin " + motion +
      " Polygon \"P\" [-0.5 -0.5 0 0.5 -0.5 0 0.5 0.5 0 -0.5 0.5 0] WorldEnd");
}

double shareOf(const DeepFrame& frame, int x, int y) {
  return static_cast<double>(covered(frame, x, y)) / frame.samplesPerPixel;
}

TEST(MotionOfFrames, MayHaveAnyNumberOfUnequalKeysSomeOfThemOutsideTheShutter) {
  const double times[] = {-1, 0.2, 0.5, 0.55, 0.9, 3}, places[] = {-2, 0.4, -1.1, 1.9, 1.9, 0};
  const DeepFrame frame = moved(
      "MotionBegin [-1 0.2 0.5 0.55 0.9 3] Translate -2 0 0 Translate 0.4 0 0 Translate -1.1 0 0 Translate 1.9 0 0 "
      "Translate 1.9 0 0 Translate 0 0 0 MotionEnd");
  const auto at = [&](double t) {
    size_t k = 0;
    while (times[k + 1] < t) ++k;
    return places[k] + (places[k + 1] - places[k]) * (t - times[k]) / (times[k + 1] - times[k]);
  };
  for (int x = 0; x < 64; ++x) {
    double expected = 0;
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i) {
      const double left = 10 * (at((i + 0.5) / kSteps) - 0.5) + 32;  // of the square, in pixels
      expected += std::max(0.0, std::min(x + 1.0, left + 10) - std::max<double>(x, left)) / kSteps;
    }
    EXPECT_NEAR(shareOf(frame, x, 32), expected, 0.05) << x;
  }
}

TEST(MotionOfFrames, ATurnFollowsItsArcAndNotTheChord) {
  // Two units out, from the right by a quarter to the top: the middle of the arc lies at 1.41, that of the chord at 1.
  const DeepFrame frame =
      moved("MotionBegin [0 1] Rotate 0 0 0 1 Rotate 90 0 0 1 MotionEnd Translate 2 0 0 Scale 0.4 0.4 1");
  EXPECT_GT(shareOf(frame, 32 + 14, 32 - 15), 0.05);
  EXPECT_EQ(shareOf(frame, 32 + 10, 32 - 11), 0);
  double sum = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) sum += shareOf(frame, x, y);
  EXPECT_NEAR(sum, 16, 0.3) << "the area of the square, whenever it is seen";
}

TEST(MotionOfFrames, KeysThatAllLieOnOneSideOfTheShutterHoldTheNearest) {
  for (const char* motion : {"MotionBegin [-3 -1] Translate -1 0 0 Translate 1 0 0 MotionEnd",
                             "MotionBegin [2 3] Translate 1 0 0 Translate -1 0 0 MotionEnd"}) {
    const DeepFrame frame = moved(motion);
    EXPECT_EQ(shareOf(frame, 42, 32), 1) << motion;
    EXPECT_EQ(shareOf(frame, 30, 32), 0) << motion;
  }
}

TEST(MotionOfFrames, WithoutBlurEverythingStandsWhereItIsWhenTheShutterOpens) {
  for (const char* shutter : {"Shutter 0.25 0.25", "Shutter 0.25 1 Hider \"hidden\" \"int samplemotion\" 0"}) {
    const DeepFrame frame = moved("MotionBegin [0 1] Translate -1.5 0 0 Translate 1.5 0 0 MotionEnd", shutter);
    // The middle is at -0.75, the sides are at -1.25 and -0.25.
    EXPECT_EQ(shareOf(frame, 18, 32), 0) << shutter;
    for (int x = 20; x < 29; ++x) EXPECT_EQ(shareOf(frame, x, 32), 1) << shutter << ' ' << x;
    EXPECT_EQ(shareOf(frame, 30, 32), 0) << shutter;
    EXPECT_NEAR(shareOf(frame, 19, 32), 0.5, 0.05) << shutter;
    EXPECT_NEAR(shareOf(frame, 29, 32), 0.5, 0.05) << shutter;
  }
}

}  // namespace
}  // namespace tomales
