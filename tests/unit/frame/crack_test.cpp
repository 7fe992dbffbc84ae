// Closed bodies in front of nothing: a sample inside the silhouette that sees nothing looks through a crack.
#include <fmt/format.h>

#include "tests/unit/frame/hidden_body.h"

namespace tomales {
namespace {
using namespace test;

constexpr const char* kTorus = "Torus 0.75 0.3 0 360 360";
constexpr const char* kCube =
    "Rotate 20 1 1 0 SubdivisionMesh \"catmull-clark\" [4 4 4 4 4 4] [0 1 3 2 4 6 7 5 0 4 5 1 2 3 7 6 0 2 6 "
    "4 1 5 7 3] "
    "[\"interpolateboundary\"] [0 0] [] [] \"P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 "
    "1]";
constexpr const char* kBumpy =
    "Attribute \"displacementbound\" \"float sphere\" [0.12] "
    "Displacement \"noisybump\" \"float Km\" [0.1] \"float frequency\" [3] \"float octaves\" [2] Sphere 0.9 "
    "-0.9 0.9 360";

constexpr const char* kNurbsSphere =
    "NuPatch 9 3 [0 0 0 1 1 2 2 3 3 4 4 4] 0 4 5 3 [0 0 0 1 1 2 2 2] 0 2 \"Pw\" ["
    "0 0 -1 1 0 0 -0.707107 0.707107 0 0 -1 1 0 0 -0.707107 0.707107 0 0 -1 1 0 0 -0.707107 0.707107 "
    "0 0 -1 1 0 0 -0.707107 0.707107 0 0 -1 1 0.707107 0 -0.707107 0.707107 0.5 0.5 -0.5 0.5 0 "
    "0.707107 -0.707107 0.707107 -0.5 0.5 -0.5 0.5 -0.707107 0 -0.707107 0.707107 -0.5 -0.5 -0.5 0.5 "
    "0 -0.707107 -0.707107 0.707107 0.5 -0.5 -0.5 0.5 0.707107 0 -0.707107 0.707107 1 0 0 1 0.707107 "
    "0.707107 0 0.707107 0 1 0 1 -0.707107 0.707107 0 0.707107 -1 0 0 1 -0.707107 -0.707107 0 "
    "0.707107 0 -1 0 1 0.707107 -0.707107 0 0.707107 1 0 0 1 0.707107 0 0.707107 0.707107 0.5 0.5 0.5 "
    "0.5 0 0.707107 0.707107 0.707107 -0.5 0.5 0.5 0.5 -0.707107 0 0.707107 0.707107 -0.5 -0.5 0.5 "
    "0.5 0 -0.707107 0.707107 0.707107 0.5 -0.5 0.5 0.5 0.707107 0 0.707107 0.707107 0 0 1 1 0 0 "
    "0.707107 0.707107 0 0 1 1 0 0 0.707107 0.707107 0 0 1 1 0 0 0.707107 0.707107 0 0 1 1 0 0 "
    "0.707107 0.707107 0 0 1 1 "
    "]";
constexpr const char* kDisplace =
    "Attribute \"displacementbound\" \"float sphere\" [0.12] "
    "Displacement \"noisybump\" \"float Km\" [0.1] \"float frequency\" [3] \"float octaves\" [2] ";
/// An octahedron whose faces are triangles, and a prism over a concave outline: every edge joins faces of different
/// rates.
constexpr const char* kOctahedron =
    "PointsPolygons [3 3 3 3 3 3 3 3] [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5] "
    "\"P\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1]";
constexpr const char* kPrism =
    "Translate -0.2 0 0 PointsPolygons [6 6 4 4 4 4 4 4] [0 5 4 3 2 1 6 7 8 9 10 11 0 1 7 6 1 2 8 7 2 3 9 8 3 4 10 9 4 "
    "5 11 10 5 0 "
    "6 11] \"P\" [-0.8 -0.8 -0.7 0.8 -0.8 -0.7 0.8 -0.1 -0.7 0.2 0 -0.7 0.2 0.8 -0.7 -0.8 0.8 -0.7 "
    "-0.8 -0.8 0.7 0.8 -0.8 0.7 0.8 -0.1 0.7 0.2 0 0.7 0.2 0.8 0.7 -0.8 0.8 0.7]";
constexpr const char* kSplineTorus =
    "Basis \"b-spline\" 1 \"b-spline\" 1 PatchMesh \"bicubic\" 4 \"periodic\" 4 \"periodic\" \"P\" ["
    "1.4 0 0 0 1.4 0 -1.4 0 0 0 -1.4 0 0.9 0 0.7 0 0.9 0.7 -0.9 0 0.7 0 -0.9 0.7 "
    "0.3 0 0 0 0.3 0 -0.3 0 0 0 -0.3 0 0.9 0 -0.7 0 0.9 -0.7 -0.9 0 -0.7 0 -0.9 -0.7]";
const std::string kBumpyCube = std::string(kDisplace) + kCube, kBumpyTorus = std::string(kDisplace) + kTorus,
                  kBumpyNurbs = std::string(kDisplace) + kNurbsSphere;

/// Two poles of 60 slivers each, whose neighbours hardly ever have the same rate.
std::string bipyramid() {
  constexpr int kCount = 60;
  std::string counts, faces, points = "0 0 1 0 0 -1 ";
  for (int k = 0; k < kCount; ++k) {
    const float angle = 2 * kPi * static_cast<float>(k) / kCount;
    const int a = 2 + k, b = 2 + (k + 1) % kCount;
    counts += "3 3 ";
    faces += fmt::format("0 {0} {1} 1 {1} {0} ", a, b);
    points += fmt::format("{:.5f} {:.5f} 0 ", std::cos(angle), std::sin(angle));
  }
  return "SubdivisionMesh \"catmull-clark\" [" + counts + "] [" + faces + "] [] [] [] [] \"P\" [" + points + "] ";
}

/// A tube between two ends with sharp rims, whose sides and caps are displaced apart, and one that closes on itself.
constexpr const char* kTube =
    "Attribute \"dice\" \"int roundcurve\" [1] Curves \"cubic\" [4] \"nonperiodic\" \"P\" [-1.2 -0.6 0 -0.4 0.9 0 0.4 "
    "-0.9 0 1.2 0.6 0] "
    "\"constantwidth\" [0.6]";
constexpr const char* kRing =
    "Attribute \"dice\" \"int roundcurve\" [1] Basis \"b-spline\" 1 \"b-spline\" 1 Curves \"cubic\" [6] \"periodic\" "
    "\"P\" [1.4 0 0  0.7 "
    "0.5 1.2  -0.7 -0.3 1.2  -1.4 0 0  -0.7 0.5 -1.2  0.7 -0.3 -1.2] \"constantwidth\" [0.5]";

struct Body {
  const char* name;
  std::string rib;
  int most = 0;  ///< Samples that may see through it, at any rate.
};
class Crack : public testing::TestWithParam<Body> {};

TEST_P(Crack, AppearsInNoClosedBodyAtAnyShadingRate) {
  for (const char* rate : {"0.25", "1", "4"})
    for (const char* turn : {"", "Rotate 70 0 1 0.2 ", "Rotate 130 1 0.4 0 "}) {
      const Holes found = holes(hide("ShadingRate " + std::string(rate) + " " + turn + GetParam().rib));
      EXPECT_GT(found.inside_px, 1500);
      EXPECT_EQ(found.samples, 0) << "rate " << rate << " " << turn;
    }
}

TEST_P(Crack, AppearsInNoneWhenGridsAreSmall) {
  for (const char* size : {"4", "23"}) {
    const Holes found = holes(hide(GetParam().rib, "Option \"limits\" \"gridsize\" [" + std::string(size) + "]"));
    EXPECT_GT(found.inside_px, 1500);
    EXPECT_EQ(found.samples, 0) << "grids of " << size;
  }
}

TEST_P(Crack, AppearsInNoneThatMovesOrIsOutOfFocus) {
  // 8 degrees at radius 1 are 8 px between the extremes; the circle of confusion at z = 3.2 is 176 / 8 * 0.19
  // = 4 px.
  constexpr int kBlur_px = 6;
  const std::string body = GetParam().rib;
  const Holes moving =
      holes(hide("MotionBegin [0 1] Rotate 0 1 1 0 Rotate 8 1 1 0 MotionEnd " + body, "Shutter 0 1"), kBlur_px);
  EXPECT_GT(moving.inside_px, 500);
  EXPECT_EQ(moving.samples, 0);
  const Holes blurred = holes(hide(body, "DepthOfField 4 1 2"), kBlur_px);
  EXPECT_GT(blurred.inside_px, 500);
  EXPECT_EQ(blurred.samples, 0);
}

/// Bumps finer than a micropolygon, at rates from far too fine to far too coarse.
class DisplacedCrack : public testing::TestWithParam<Body> {};

TEST_P(DisplacedCrack, IsSmallHoweverFarMicropolygonsMissTheBumps) {
  const std::string shader =
      "Attribute \"displacementbound\" \"float sphere\" [0.2] Displacement \"noisybump\" \"float Km\" [0.12] \"float "
      "frequency\" [3] "
      "\"float octaves\" [4] ";
  for (const char* rate : {"0.5", "1", "4", "16", "100"}) {
    const Holes found = holes(hide("ShadingRate " + std::string(rate) + " " + shader + GetParam().rib, {},
                                   "Sides 1 Translate 0 0 4.5 Rotate 30 1 0.3 0 "));
    EXPECT_GT(found.inside_px, 700);
    EXPECT_LE(found.samples, GetParam().most) << "rate " << rate;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, DisplacedCrack,
                         testing::Values(Body{"Sphere", kSphere}, Body{"Torus", kTorus}, Body{"SubdivisionCube", kCube},
                                         Body{"NurbsSphere", kNurbsSphere}, Body{"BSplineTorus", kSplineTorus},
                                         Body{"Slivers", bipyramid(), 1}, Body{"Tube", kTube}, Body{"Ring", kRing}),
                         [](const auto& p) { return p.param.name; });

INSTANTIATE_TEST_SUITE_P(Bodies, Crack,
                         testing::Values(Body{"Sphere", kSphere}, Body{"Torus", kTorus}, Body{"SubdivisionCube", kCube},
                                         Body{"DisplacedSphere", kBumpy}, Body{"NurbsSphere", kNurbsSphere},
                                         Body{"BSplineTorus", kSplineTorus}, Body{"Octahedron", kOctahedron},
                                         Body{"ConcavePrism", kPrism}, Body{"DisplacedSubdivision", kBumpyCube},
                                         Body{"DisplacedTorus", kBumpyTorus}, Body{"DisplacedNurbs", kBumpyNurbs}),
                         [](const auto& p) { return p.param.name; });

/// Rows of a paraboloid are far apart at its tip, so that points of a meridian are not evenly spaced, though
/// it is seen straight.
TEST(Overlap, OfTheMeridiansOfATransparentParaboloidIsNoneAtItsTip) {
  const DeepFrame frame = hide("Opacity 0.5 0.5 0.5 Paraboloid 1 0 1 360", "", "Translate 0 0 3 ");
  int layers = 0, samples = 0;
  for (int y = 44; y < 84; ++y)
    for (int x = 44; x < 84; ++x) {
      layers += covered(frame, x, y);
      samples += frame.samplesPerPixel;
    }
  EXPECT_NEAR(layers, samples, samples / 5000);
}

}  // namespace
}  // namespace tomales
