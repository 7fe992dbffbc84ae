// Clipping, sample by sample. One unit is 32 pixels where rays are parallel.
#include "tests/unit/frame/hidden_body.h"

namespace tomales::test {
namespace {

constexpr double kUnit_px = 32;

DeepFrame clipped(const std::string& planes, const std::string& body) {
  return hideRib("Format 128 128 1 PixelSamples 4 4 PixelFilter \"box\" 1 1 ScreenWindow -2 2 -2 2 Clipping 0.1 100 " +
                 planes + " Translate 0 0 10 WorldBegin " + body + " WorldEnd");
}

struct Seen {
  double area = 0, nearest = 1e9, farthest = 0;
};
Seen look(const DeepFrame& f) {
  Seen s;
  for (int y = f.crop.y0; y < f.crop.y1; ++y)
    for (int x = f.crop.x0; x < f.crop.x1; ++x)
      forFragments(f, x, y, [&](const DeepTile&, const Fragment& g) {
        s.area += std::popcount(g.samples) / (kUnit_px * kUnit_px * f.samplesPerPixel);
        s.nearest = std::min(s.nearest, double{g.z});
        s.farthest = std::max(s.farthest, double{g.z});
      });
  return s;
}

constexpr const char* kBall = "Sphere 1 -1 1 360";

TEST(Clipping, APlaneTakesTheSideThatItsNormalPointsTo) {
  const double segment = std::acos(0.5) - 0.5 * std::sqrt(0.75);
  EXPECT_NEAR(look(clipped("ClippingPlane 0.5 0 0 1 0 0", kBall)).area, double{kPi} - segment, 0.004);
  EXPECT_NEAR(look(clipped("ClippingPlane 0.5 0 0 -1 0 0", kBall)).area, segment, 0.004);
}

TEST(Clipping, AnyNumberOfPlanesCutTogether) {
  // A wedge of 60 degrees.
  EXPECT_NEAR(look(clipped("ClippingPlane 0 0 0 0 1 0 ClippingPlane 0 0 0 0.8660254 -0.5 0", kBall)).area,
              double{kPi} / 6, 0.005);
}

TEST(Clipping, APlaneStandsInTheSpaceOfItsRequest) {
  const Seen s =
      look(clipped("TransformBegin Translate 0 0 10 Rotate 90 0 0 1 ClippingPlane 0.5 0 0 1 0 0 TransformEnd", kBall));
  EXPECT_NEAR(s.area, double{kPi} - (std::acos(0.5) - 0.5 * std::sqrt(0.75)), 0.004);
}

TEST(Clipping, NearAndFarPlanesCutExactly) {
  const DeepFrame f = hideRib(
      "Format 64 64 1 PixelSamples 3 3 Projection \"perspective\" \"fov\" 30 Clipping 9.7 10.4 Translate 0 0 10 "
      "WorldBegin "
      "Rotate 30 1 1 0 Sphere 1 -1 1 360 WorldEnd");
  const Seen s = look(f);
  EXPECT_GT(s.nearest, 9.7 - 1e-3);
  EXPECT_LT(s.farthest, 10.4 + 1e-3);
  EXPECT_LT(s.nearest, 9.75);
  EXPECT_GT(s.farthest, 10.3);
}

TEST(Clipping, CutsASolidAfterItIsWhole) {
  // Planes take the cutter's near half and the ball's front; the hollow that the cutter leaves stays.
  const std::string hollow =
      "SolidBegin \"difference\" SolidBegin \"primitive\" Sphere 1 -1 1 360 SolidEnd SolidBegin \"primitive\" Sphere "
      "0.5 -0.5 0.5 "
      "360 SolidEnd SolidEnd";
  const DeepFrame f = clipped("ClippingPlane 0 0 10 0 0 -1", hollow);
  forFragments(f, 64, 64, [](const DeepTile&, const Fragment& g) { EXPECT_NEAR(g.z, 10.5, 0.01); });
  EXPECT_NEAR(look(f).area, double{kPi}, 0.01);
  const DeepFrame far = clipped("ClippingPlane 0 0 9.3 0 0 1", hollow);
  forFragments(far, 64, 64, [](const DeepTile&, const Fragment& g) { EXPECT_NEAR(g.z, 9, 0.01); });
}

TEST(Clipping, CutsWhatMovesAndIsOutOfFocusWhereItIs) {
  const std::string rib =
      "Format 128 128 1 PixelSamples 4 4 Projection \"perspective\" \"fov\" 20 Clipping 1 100 Shutter 0 1 DepthOfField "
      "2 0.5 8 "
      "ClippingPlane 0 0 10 0 0 1 WorldBegin MotionBegin [0 1] Translate -0.4 0 10 Translate 0.4 0 10 MotionEnd ";
  EXPECT_LT(look(hideRib(rib + "Sphere 1 -1 1 360 WorldEnd")).farthest, 10 + 1e-3);
}

}  // namespace
}  // namespace tomales::test
