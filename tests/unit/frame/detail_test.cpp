// Levels of detail as samples see them: one unit is 32 pixels, so the Detail box of one unit has 1024 px2.
#include "tests/unit/frame/hidden_body.h"

namespace tomales::test {
namespace {

const std::string kRuler = "Detail [-0.5 0.5 -0.5 0.5 -0.5 0.5] ";
/// A square of 2 units at depth 10 + z.
std::string level(const std::string& range, const std::string& z) {
  return "DetailRange [" + range + "] TransformBegin Translate 0 0 " + z +
         " Polygon \"P\" [-1 -1 0 -1 1 0 1 1 0 1 -1 0] TransformEnd ";
}

/// Samples inside the square that see a level at depth 10, one at 11, and both, as parts of all.
struct Parts {
  double near = 0, far = 0, twice = 0;
};
Parts parts(const std::string& body, const std::string& options = {}) {
  const DeepFrame f =
      hideRib("Format 128 128 1 PixelSamples 4 4 PixelFilter \"box\" 1 1 ScreenWindow -2 2 -2 2 Clipping 0.1 100 " +
              options + " Translate 0 0 10 WorldBegin Opacity 0.5 0.5 0.5 " + body + " WorldEnd");
  Parts p;
  const double sample = 1.0 / (40 * 40 * 16);
  for (int y = 44; y < 84; ++y)
    for (int x = 44; x < 84; ++x) {
      uint64_t near = 0, far = 0;
      forFragments(f, x, y, [&](const DeepTile&, const Fragment& g) { (g.z < 10.5f ? near : far) |= g.samples; });
      p.near += sample * std::popcount(near);
      p.far += sample * std::popcount(far);
      p.twice += sample * std::popcount(near & far);
    }
  return p;
}

TEST(Detail, OneLevelIsThereOutsideOfTransitions) {
  const Parts p = parts(kRuler + level("0 0 500 600", "0") + level("500 600 1e38 1e38", "1"));
  EXPECT_EQ(p.near, 0);
  EXPECT_NEAR(p.far, 1, 1e-9);
}

TEST(Detail, LevelsInTransitionShareTheSamplesAmongThem) {
  // 1024 lies at 0.24 of 1000..1100.
  const Parts p = parts(kRuler + level("0 0 1000 1100", "0") + level("1000 1100 1e38 1e38", "1"));
  EXPECT_NEAR(p.near, 0.76, 0.005);
  EXPECT_NEAR(p.far, 0.24, 0.005);
  EXPECT_EQ(p.twice, 0);
  EXPECT_NEAR(p.near + p.far, 1, 1e-9);
}

TEST(Detail, RelativeDetailScalesTheRuler) {
  const Parts p = parts(kRuler + level("0 0 2000 2200", "0") + level("2000 2200 1e38 1e38", "1"), "RelativeDetail 2");
  EXPECT_NEAR(p.far, 0.24, 0.005);
}

TEST(Detail, NestedRangesDivideWhatIsLeftToThem) {
  const std::string inner = kRuler + level("0 0 974 1074", "0") + level("974 1074 1e38 1e38", "1");  // halves
  const Parts p = parts(kRuler + "DetailRange [0 0 1000 1100] AttributeBegin " + inner + " AttributeEnd " +
                        level("1000 1100 1e38 1e38", "1"));
  EXPECT_NEAR(p.near, 0.76 * 0.5, 0.006);
  EXPECT_EQ(p.twice, 0);
  EXPECT_NEAR(p.near + p.far, 1, 1e-9);
}

TEST(Detail, BoxesThatReachTheEyeAreAsLargeAsCanBe) {
  const DeepFrame f = hideRib(
      "Format 32 32 1 Projection \"perspective\" \"fov\" 40 WorldBegin Detail [-1 1 -1 1 -1 20] "
      "Translate 0 0 10 DetailRange [0 0 1e6 1e6] Sphere 1 -1 1 360 WorldEnd");
  EXPECT_EQ(covered(f, 16, 16), 0);
}

}  // namespace
}  // namespace tomales::test
