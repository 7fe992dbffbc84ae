// Solids as samples see them, against closed forms. One unit is 32 pixels, seen along z by parallel rays.
#include "tests/unit/frame/hidden_body.h"

namespace tomales::test {
namespace {

constexpr float kSide_px = 32;

std::string world(const std::string& body, const std::string& options = {}) {
  return "Format 128 128 1 PixelSamples 4 4 PixelFilter \"box\" 1 1 ScreenWindow -2 2 -2 2 Clipping 0.1 100 "
         "ShadingRate 1 " +
         options + " Translate 0 0 10 WorldBegin " + body + " WorldEnd";
}
std::string primitive(const std::string& body) { return " SolidBegin \"primitive\" " + body + " SolidEnd "; }
std::string solid(const std::string& operation, const std::string& parts) {
  return " SolidBegin \"" + operation + "\" " + parts + " SolidEnd ";
}
std::string moved(const std::string& where, const std::string& what) {
  return " TransformBegin Translate " + where + what + " TransformEnd ";
}
/// The box from (x0, y0, z0) to (x1, y1, z1), six polygons.
std::string box(float x0, float y0, float z0, float x1, float y1, float z1) {
  std::string out;
  const float at[2][3] = {{x0, y0, z0}, {x1, y1, z1}};
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      out += " Polygon \"P\" [";
      for (int k = 0; k < 4; ++k) {
        int corner[3];
        corner[axis] = side;
        const int first = (axis + 1 + side) % 3 == axis ? (axis + 2) % 3 : (axis + 1) % 3;
        corner[first] = k == 1 || k == 2;
        corner[3 - axis - first] = k >= 2;
        for (int c = 0; c < 3; ++c) out += std::to_string(at[corner[c]][c]) + " ";
      }
      out += "]";
    }
  return primitive(out);
}
const std::string kUnitBall = primitive("Sphere 1 -1 1 360");
const std::string kCylinder = primitive("Cylinder 1 -1.8 1.8 360 Disk 1.8 1 360 Disk -1.8 1 360");

struct Measured {
  double area = 0, volume = 0;  ///< The second: of the room between what is seen and the plane z = 10.
};
Measured measure(const DeepFrame& frame) {
  Measured m;
  const double cell = 1.0 / (kSide_px * kSide_px * static_cast<double>(frame.samplesPerPixel));
  for (int y = frame.crop.y0; y < frame.crop.y1; ++y)
    for (int x = frame.crop.x0; x < frame.crop.x1; ++x)
      forFragments(frame, x, y, [&](const DeepTile&, const Fragment& f) {
        m.area += cell * std::popcount(f.samples);
        m.volume += cell * std::popcount(f.samples) * (10 - double{f.z});
      });
  return m;
}

/// Mean number of surfaces that the samples of a pixel see, one behind the other.
double surfaces(const DeepFrame& frame, float x, float y) {
  const int px = static_cast<int>((x + 2) * kSide_px), py = static_cast<int>((2 - y) * kSide_px);
  return covered(frame, px, py) / static_cast<double>(frame.samplesPerPixel);
}

TEST(Solids, ALensHasTheAreaOfTwoCirclesThatOverlap) {
  const DeepFrame f = hideRib(world(solid("intersection", moved("-0.5 0 0", kUnitBall) + moved("0.5 0 0", kUnitBall))));
  EXPECT_NEAR(measure(f).area, 2 * std::acos(0.5) - 0.5 * std::sqrt(3.0), 0.004);
}

TEST(Solids, ASphereLosesTheSegmentThatABoxCutsOff) {
  const DeepFrame f = hideRib(world(solid("difference", kUnitBall + box(0.5f, -2, -2, 2, 2, 2))));
  const double segment = std::acos(0.5) - 0.5 * std::sqrt(0.75);
  EXPECT_NEAR(measure(f).area, double{kPi} - segment, 0.004);
}

TEST(Solids, TwoCrossedCylindersMakeTheSolidOfSteinmetz) {
  const DeepFrame f = hideRib(
      world(solid("intersection", "TransformBegin Rotate 90 1 0 0 " + kCylinder +
                                      " TransformEnd TransformBegin Rotate 90 0 1 0 " + kCylinder + "TransformEnd"),
            "ShadingRate 0.5"));
  const Measured m = measure(f);
  EXPECT_NEAR(m.area, 4, 0.01);
  // Half of 16/3 lies in front of the middle; fragments tell the nearest of their samples, a little more.
  EXPECT_NEAR(m.volume, 8.0 / 3, 0.04);
}

TEST(Solids, ADifferenceShowsTheFarSideOfWhatItTakesAway) {
  // A bowl: the upper half of what is seen is cut by a ball half as large, whose own surface shows.
  const DeepFrame f =
      hideRib(world(solid("difference", kUnitBall + moved("0 0 -1", primitive("Sphere 0.5 -0.5 0.5 360")))));
  const Measured whole = measure(hideRib(world(kUnitBall)));
  EXPECT_NEAR(measure(f).area, whole.area, 1e-9);
  // What is gone: two caps that meet, of heights 1/8 of the ball and 3/8 of the cutter.
  const auto cap = [](double r, double h) { return double{kPi} * h * h * (3 * r - h) / 3; };
  EXPECT_NEAR(whole.volume - measure(f).volume, cap(1, 0.125) + cap(0.5, 0.375), 0.005);
  // The cut surface turns its normal to the eye, and away from its own centre no more.
  forFragments(f, 64, 64, [&](const DeepTile& t, const Fragment& fragment) {
    const Facet& facet = t.facets[fragment.facet];
    const ShadePoints& points = t.batches[static_cast<size_t>(facet.batch)];
    EXPECT_NEAR(fragment.z, 9.5f, 0.01f);
    EXPECT_LT(points.get3(kNx, facet.point[0]).z, -0.99f);
    EXPECT_LT(points.get3(kNgx, facet.point[0]).z, -0.99f);
  });
}

TEST(Solids, AreWholeInProceduralsThatAreOpenedOnDemand) {
  const std::string hollow = solid("difference", kUnitBall + moved("0 0 -1", primitive("Sphere 0.5 -0.5 0.5 360")));
  const std::string lens = solid("intersection", moved("-0.5 0 0", kUnitBall) + moved("0.5 0 0", kUnitBall));
  const auto scene = [&](const std::string& first, const std::string& second) {
    return measure(
        hideRib(world("ArchiveBegin \"hollow\" " + hollow + " ArchiveEnd ArchiveBegin \"lens\" " + lens +
                      " ArchiveEnd " + moved("-1 1 0", lens) + moved("-1 -1 0", first) + moved("1 0 0", second))));
  };
  const auto procedural = [](const std::string& name) {
    return " Procedural \"DelayedReadArchive\" [\"" + name + "\"] [-1 1 -1 1 -1.5 1]";
  };
  const Measured read = scene(hollow, lens), opened = scene(procedural("hollow"), procedural("lens"));
  EXPECT_NEAR(opened.area, read.area, 1e-9);
  EXPECT_NEAR(opened.volume, read.volume, 1e-6);
}

TEST(Solids, AUnionHasNoSurfacesInside) {
  const DeepFrame f = hideRib(
      world("Opacity 0.5 0.5 0.5 " + solid("union", moved("-0.4 0 0", kUnitBall) + moved("0.4 0 0", kUnitBall))));
  EXPECT_EQ(surfaces(f, 0, 0), 2);
  const DeepFrame apart =
      hideRib(world("Opacity 0.5 0.5 0.5 " + moved("-0.4 0 0", kUnitBall) + moved("0.4 0 0", kUnitBall)));
  EXPECT_EQ(surfaces(apart, 0, 0), 4);
}

TEST(Solids, OnlyTheWholeHidesWhatIsBehind) {
  const std::string behind = "Color 1 0 0 Translate 0 0 5 Polygon \"P\" [-2 -2 0 -2 2 0 2 2 0 2 -2 0] ";
  const std::string hole = "TransformBegin Rotate 0 1 0 0 Scale 0.5 0.5 1 " + kCylinder + " TransformEnd ";
  // The hole is drilled along the view, so its middle shows the wall, at any order and bucket size.
  for (const int bucket : {16, 7, 64}) {
    const DeepFrame f = hideRib(world(
        solid("difference", kUnitBall + hole) + behind,
        "Option \"limits\" \"integer[2] bucketsize\" [" + std::to_string(bucket) + " " + std::to_string(bucket) + "]"));
    forFragments(f, 64, 64, [&](const DeepTile&, const Fragment& g) { EXPECT_NEAR(g.z, 15, 1e-3); });
    EXPECT_NEAR(measure(f).area, 16, 1e-3);  // Nothing is missing, nothing shows through.
  }
}

TEST(Solids, AreWholeAtARimWhereTheNormalOfADiskPointsInwards) {
  // A line through the rim enters by the wall and leaves by the disk at once. If these two were taken for one, the line
  // would count as one that begins in the can, and would show the cutter in front of it.
  const std::string can = primitive("Cylinder 1 -1 1 360 Disk 1 1 360 Disk -1 1 360");
  const std::string cutter = moved("0 0 3", primitive("Cylinder 0.8 -5 0 360 Disk 0 0.8 360 Disk -5 0.8 360"));
  const DeepFrame f = hideRib(world("Rotate -60 1 0 0 " + solid("difference", can + cutter)));
  const DeepFrame outward = hideRib(world(
      "Rotate -60 1 0 0 " +
      solid("difference", primitive("Cylinder 1 -1 1 360 Disk 1 1 360 ReverseOrientation Disk -1 1 360") + cutter)));
  EXPECT_EQ(measure(f).volume, measure(outward).volume);
}

TEST(Solids, InFrontHideThemFromAllTheirParts) {
  const std::string wall = "TransformBegin Translate 0 0 -5 Polygon \"P\" [-2 -2 0 -2 2 0 2 2 0 2 -2 0] TransformEnd ";
  const DeepFrame f = hideRib(world(solid("difference", kUnitBall + moved("0 0 -1", kUnitBall)) + wall));
  for (int y = 1; y < 127; ++y)
    for (int x = 1; x < 127; ++x)
      forFragments(f, x, y, [&](const DeepTile&, const Fragment& g) { ASSERT_NEAR(g.z, 5, 1e-3) << x << "," << y; });
}

TEST(Solids, SidesOneKeepsTheSurfaceThatTheSubtractedLeaves) {
  const std::string parts = kUnitBall + moved("0 0 -1", primitive("Sphere 0.5 -0.5 0.5 360"));
  const Measured two = measure(hideRib(world(solid("difference", parts))));
  const Measured one = measure(hideRib(world("Sides 1 " + solid("difference", parts))));
  EXPECT_EQ(one.area, two.area);
  EXPECT_EQ(one.volume, two.volume);
}

TEST(Solids, MayHaveTheEyeInside) {
  const std::string room = solid("difference", box(-3, -3, -3, 3, 3, 3) + box(-2.5f, -2.5f, -2.5f, 2.5f, 2.5f, 2.5f));
  const DeepFrame f = hideRib(
      "Format 64 64 1 PixelSamples 3 3 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 90 WorldBegin " +
      room + " WorldEnd");
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      ASSERT_EQ(covered(f, x, y), 9) << x << "," << y;
      forFragments(f, x, y, [&](const DeepTile&, const Fragment& g) { ASSERT_LT(g.z, 2.51f); });
    }
}

TEST(Solids, InvisiblePartsStillCut) {
  const std::string cutter = "AttributeBegin Surface \"null\" " + moved("0 0 -1", kUnitBall) + " AttributeEnd ";
  const DeepFrame f = hideRib(world(solid("difference", kUnitBall + cutter)));
  // The ring that the cutter leaves is seen from the front; through the hollow, the back of the ball.
  forFragments(f, 64, 64, [&](const DeepTile&, const Fragment& g) { EXPECT_NEAR(g.z, 11, 0.01f); });
}

TEST(Solids, MoveAsAWhole) {
  const std::string lens = solid("intersection", moved("-0.5 0 0", kUnitBall) + moved("0.5 0 0", kUnitBall));
  const Measured still = measure(hideRib(world(lens)));
  const Measured moving = measure(
      hideRib(world("MotionBegin [0 1] Translate -0.6 0 0 Translate 0.6 0.2 0 MotionEnd " + lens, "Shutter 0 1")));
  EXPECT_NEAR(moving.area, still.area, 0.02);
  EXPECT_NEAR(moving.volume, still.volume, 0.02);
}

TEST(Solids, AreOutOfFocusAsAWhole) {
  const std::string parts = solid("difference", kUnitBall + moved("0 0 -1", kUnitBall));
  const std::string camera =
      "Format 64 64 1 PixelSamples 6 6 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 30 Clipping 1 100 ";
  const auto hide = [&](const std::string& lens) {
    return hideRib(camera + lens + " Translate 0 0 10 WorldBegin " + parts + " WorldEnd");
  };
  const DeepFrame sharp = hide(""), blurred = hide("DepthOfField 1 0.6 6");
  double a = 0, b = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      a += covered(sharp, x, y);
      b += covered(blurred, x, y);
    }
  EXPECT_NEAR(b / a, 1, 0.03);
  EXPECT_LT(covered(blurred, 32, 13), 36);  // At the rim of the ball, half of the lens sees past it.
}

}  // namespace
}  // namespace tomales::test
