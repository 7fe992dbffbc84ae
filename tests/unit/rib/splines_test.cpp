#include "tests/unit/rib/rib_test_tools.h"

namespace tomales {
namespace {

vec3 normalInTheMiddle(const Prim& prim, uint32_t patch) {
  const float half = 0.5f;
  float f[12];
  prim.evaluate(patch, 1, &half, &half,
                {f, f + 1, f + 2, f + 3, f + 4, f + 5, f + 6, f + 7, f + 8, f + 9, f + 10, f + 11});
  return glm::normalize(vec3(f[9], f[10], f[11]));
}

TEST(Geometry, WithHolesLeavesThemOut) {
  const Reading r(
      inWorld("GeneralPolygon [4 3] \"P\" [0 0 0 9 0 0 9 9 0 0 9 0  1 1 0 2 1 0 1 2 0]\n"
              "PointsGeneralPolygons [2] [4 3] [0 1 2 3 4 5 6] "
              "\"P\" [0 0 0 9 0 0 9 9 0 0 9 0  1 1 0 2 1 0 1 2 0]"));
  EXPECT_EQ(r.codes(), "");
  ASSERT_EQ(r.scene().objects.size(), 2u);
  EXPECT_EQ(r.object(0).shape().patchCount(), 7u);
}

TEST(Geometry, NuPatchHasAPatchForEveryKnotInterval) {
  const Reading r(inWorld("NuPatch 3 2 [0 0 1 2 2] 0 2 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0]"));
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(r.object(0).shape().patchCount(), 2u);
}

TEST(Geometry, NuPatchThatIsNoneIsDroppedByName) {
  const Reading r(
      inWorld("NuPatch 3 2 [0 0 1] 0 2 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0]\n"
              "NuPatch 2 2 [] 0 1 2 2 [] 0 1 \"P\" []"));
  EXPECT_EQ(r.log.count("rib-object-dropped"), 2);
  EXPECT_TRUE(r.scene().objects.empty());
}

constexpr const char* kTriangleTrim =
    "TrimCurve [1] [2] [0 0 1 2 3 3] [0] [3] [4] [0.2 0.8 0.8 0.2] [0.2 0.2 0.8 0.2] [1 1 1 1]\n";
constexpr const char* kUnitNuPatch = "NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n";

TEST(Geometry, TrimCurvesBelongToTheAttributesAndTheirSenseIsTheSideCutAway) {
  const std::string trim = kTriangleTrim, patch = kUnitNuPatch;
  const Reading r(inWorld("AttributeBegin " + trim + patch + "Attribute \"trimcurve\" \"sense\" [\"outside\"] " +
                          patch + "AttributeEnd " + patch + trim + "TrimCurve [] [] [] [] [] [] [] [] []" + patch));
  EXPECT_EQ(r.codes(), "");
  ASSERT_EQ(r.scene().objects.size(), 4u);
  const bool inside[4] = {false, true, true, true}, outside[4] = {true, false, true, true};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(r.object(i).shape().keeps(0, 0.6f, 0.4f), inside[i]) << i;
    EXPECT_EQ(r.object(i).shape().keeps(0, 0.4f, 0.6f), outside[i]) << i;
  }
}

TEST(Geometry, InstancesAreTrimmedByTheCurvesAroundThem) {
  const std::string trim = kTriangleTrim, patch = kUnitNuPatch;
  const Reading r(
      inWorld("ObjectBegin \"a\" " + patch + "ObjectEnd ObjectInstance \"a\" " + trim + "ObjectInstance \"a\""));
  ASSERT_EQ(r.scene().objects.size(), 2u);
  EXPECT_TRUE(r.object(0).shape().keeps(0, 0.6f, 0.4f));
  EXPECT_FALSE(r.object(1).shape().keeps(0, 0.6f, 0.4f));
}

TEST(Geometry, TrimCurvesWhoseArraysDoNotAgreeAreLeftOutWithAWarning) {
  const std::string patch = kUnitNuPatch;
  const Reading r(inWorld("TrimCurve [1] [2] [0 0 1 2 3 3] [0] [3] [4] [0.2 0.8] [0.2 0.2 0.8 0.2] [1 1 1 1]\n" +
                          patch +
                          "TrimCurve [-1] [2] [] [] [] [] [] [] []\nTrimCurve [1] [2] [] [] [] [1e9] [] [] []\n"
                          "Attribute \"trimcurve\" \"sense\" [\"both\"]\n"));
  EXPECT_EQ(r.log.count("rib-trim"), 3);
  EXPECT_EQ(r.log.count("rib-attribute"), 1);
  EXPECT_TRUE(r.object(0).shape().keeps(0, 0.6f, 0.4f));
}

TEST(Geometry, RoundCurvesAreTubesUnlessTheyHaveNormals) {
  const std::string line = "Curves \"linear\" [2] \"nonperiodic\" \"P\" [0 0 0 1 0 0]";
  const Reading r(inWorld("Attribute \"dice\" \"roundcurve\" [1]\n" + line + "\n" + line +
                          " \"varying normal N\" [0 0 1 0 0 1]\n" + "Attribute \"dice\" \"roundcurve\" [0]\n" + line));
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(r.object(0).shape().patchCount(), 3u);  // with two disks
  EXPECT_EQ(r.object(1).shape().patchCount(), 1u);
  EXPECT_EQ(r.object(2).shape().patchCount(), 1u);
}

TEST(Geometry, CubicCurvesTakeTheBasisOfV) {
  const Reading r(
      inWorld("Basis \"bezier\" 3 \"b-spline\" 1\n"
              "Curves \"cubic\" [6] \"nonperiodic\" \"constantwidth\" [0.1] "
              "\"P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0]\n"
              "Curves \"linear\" [2 2] \"nonperiodic\" \"width\" [1 2 3 4] \"P\" [0 0 0 1 0 0 0 1 0 1 1 0]"));
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(r.object(0).shape().patchCount(), 3u);
  EXPECT_EQ(r.object(1).shape().patchCount(), 2u);
}

TEST(Geometry, CurvesThatAreNoneAreDroppedByName) {
  const Reading r(
      inWorld("Curves \"linear\" [1] \"nonperiodic\" \"P\" [0 0 0]\nCurves \"round\" [2] \"nonperiodic\" \"P\" "
              "[0 0 0 1 0 0]\nPoints"));
  EXPECT_EQ(r.log.count("rib-object-dropped"), 3);
}

TEST(Geometry, UnknownWrapsAreNonperiodicWithAWarning) {
  const Reading r(
      inWorld("Curves \"linear\" [2] \"around\" \"P\" [0 0 0 1 0 0]\n"
              "PatchMesh \"bilinear\" 2 \"nowrap\" 2 \"nonperiodic\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 0]"));
  ASSERT_EQ(r.scene().objects.size(), 2u);
  EXPECT_EQ(r.object(1).shape().patchCount(), 1u);
  EXPECT_EQ(r.log.worst(), Severity::Warning);
  EXPECT_NE(r.log.entries().at(1).message.find("nowrap"), std::string::npos);
}

TEST(Geometry, NoPointsAndNoCurvesAreNothingAndNothingIsMissing) {
  const Reading r(inWorld("Points \"P\" []\nCurves \"linear\" [] \"nonperiodic\" \"P\" []\nSphere 1 -1 1 360"));
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.log.count("rib-empty-mesh"), 2);
  EXPECT_EQ(r.log.worst(), Severity::Warning);
}

TEST(Geometry, PointsTurnToTheEyeThroughTheirTransformation) {
  const std::string points = "Rotate 90 0 1 0 Points \"P\" [0 0 0] \"constantwidth\" [0.5]";
  const Reading straight("Translate 0 0 5" + inWorld(points));
  EXPECT_EQ(straight.codes(), "");
  const Object& o = straight.object(0);
  const vec3 inCamera = transformVector(o.cameraFromObject.at(0), normalInTheMiddle(o.shape(), 0));
  EXPECT_NEAR(inCamera.z, -1, 1e-5f);
  const Reading perspective("Projection \"perspective\" Translate 3 0 4" + inWorld(points));
  const Object& p = perspective.object(0);
  const vec3 towards = transformVector(p.cameraFromObject.at(0), normalInTheMiddle(p.shape(), 0));
  EXPECT_NEAR(towards.x, -0.6f, 1e-5f);
  EXPECT_NEAR(towards.z, -0.8f, 1e-5f);
}

TEST(Shapes, BlobbyTeapotAndHierarchicalMeshAreRead) {
  const Reading r(
      inWorld("Blobby 2 [1001 0 1000 16 5 0 1] [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 .1] [\"\"] \"varying float k\" [1 2]\n"
              "Geometry \"teapot\"\n"
              "HierarchicalSubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"interpolateboundary\" \"creasemethod\"] "
              "[1 0 0 0 0 1]"
              " [1] [] [\"chaikin\"] \"P\" [0 0 0 1 0 0 1 1 0 0 1 0]\n"
              "SubdivisionMesh \"loop\" [3] [0 1 2] [\"interpolateboundary\"] [0 0] [] [] \"P\" [0 0 0 1 0 0 1 1 0]"));
  ASSERT_EQ(r.scene().objects.size(), 4u);
  EXPECT_GT(r.object(0).shape().patchCount(), 6u);
  EXPECT_EQ(r.object(1).shape().patchCount(), 32u);
  EXPECT_EQ(r.object(2).shape().patchCount(), 1u);
  EXPECT_EQ(r.object(3).shape().patchCount(), 3u);
  EXPECT_TRUE(r.log.entries().empty());
}

TEST(Shapes, GeometryOfAnotherNameIsMissing) {
  const Reading r(inWorld("Geometry \"bunny\"\n"));
  EXPECT_EQ(r.log.count("rib-object-dropped"), 1);
}

}  // namespace
}  // namespace tomales
