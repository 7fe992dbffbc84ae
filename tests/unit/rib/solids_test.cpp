#include "tests/unit/rib/rib_test_tools.h"

namespace tomales {
namespace {

const std::string kCube =
    "PointsPolygons [4 4 4 4 4 4] [0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5] "
    "\"P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1] ";

TEST(Solids, AreTreesOverTheirPrimitives) {
  const Reading r(
      inWorld("SolidBegin \"difference\" SolidBegin \"primitive\" Sphere 1 -1 1 360 SolidEnd SolidBegin \"union\" "
              "SolidBegin \"primitive\" Cylinder 1 -1 1 360 Disk 1 1 360 Disk -1 1 360 SolidEnd SolidBegin "
              "\"primitive\" Torus 1 0.2 0 360 360 SolidEnd SolidEnd SolidEnd Sphere 1 -1 1 360"));
  EXPECT_EQ(r.codes(), "");
  ASSERT_EQ(r.scene().solids.size(), 1U);
  EXPECT_EQ(r.scene().solids[0].blockCount(), 5);
  EXPECT_EQ(r.object(1).solidBlock, r.object(3).solidBlock);
  EXPECT_NE(r.object(0).solidBlock, r.object(1).solidBlock);
  EXPECT_FALSE(r.object(0).subtracted);
  EXPECT_TRUE(r.object(3).subtracted);
  EXPECT_TRUE(r.object(4).subtracted);
  EXPECT_EQ(r.object(5).solid, -1);
}

TEST(Solids, InRetainedObjectsAreMadeAnewForEachInstance) {
  const Reading r(inWorld("ObjectBegin 1 SolidBegin \"primitive\" " + kCube +
                          " SolidEnd ObjectEnd ObjectInstance 1 Translate 3 0 0 ObjectInstance 1"));
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(r.object(0).solid, 0);
  EXPECT_EQ(r.object(1).solid, 1);
}

class ClosedPrimitive : public testing::TestWithParam<const char*> {};
TEST_P(ClosedPrimitive, IsNotWarnedOf) {
  const Reading r(inWorld("SolidBegin \"primitive\"\n" + std::string(GetParam()) + " SolidEnd"));
  EXPECT_EQ(r.codes(), "");
}
INSTANTIATE_TEST_SUITE_P(
    Shapes, ClosedPrimitive,
    testing::Values(
        "Sphere 1 -1 1 360", "Torus 1 0.2 0 360 360", "Cone 1 1 360 Disk 0 1 360",
        "Rotate 40 1 2 3 Scale 1 2 3 Cylinder 1 -1 1 360 Disk 1 1 360 Rotate 77 0 0 1 Disk -1 1 360",
        "Sphere 1 -1 0.5 360 Disk 0.5 0.8660254 360",
        "PointsPolygons [4 4 4 4 4 4] [0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5] \"P\" [-1 -1 -1 1 -1 -1 "
        "-1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1]"));

class OpenPrimitive : public testing::TestWithParam<const char*> {};
TEST_P(OpenPrimitive, IsNamedOnceWithItsPlace) {
  const Reading r(inWorld("SolidBegin \"primitive\"\nAttribute \"identifier\" \"string name\" \"pot\"\n" +
                          std::string(GetParam()) + " SolidEnd"));
  EXPECT_EQ(r.codes(), "rib-solid-open@4 ");
  EXPECT_NE(r.message("rib-solid-open").message.find("pot"), std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(Shapes, OpenPrimitive,
                         testing::Values("Sphere 1 -1 0.5 360", "Sphere 1 -1 1 300", "Cylinder 1 -1 1 360 Disk 1 1 360",
                                         "Cylinder 1 -1 1 360 Disk 1 1 360 Disk -1 0.8 360",
                                         "Polygon \"P\" [0 0 0 1 0 0 1 1 0]", "Points \"P\" [0 0 0]"));

struct Turned {
  const char* body;
  std::vector<bool> turned;
};
class NormalsOfAPrimitive : public testing::TestWithParam<Turned> {};
TEST_P(NormalsOfAPrimitive, AreComparedAlongTheEdgesThatJoinItsObjects) {
  const Reading r(inWorld("SolidBegin \"primitive\" " + std::string(GetParam().body) + " SolidEnd"));
  std::vector<bool> turned;
  for (size_t i = 0; i < r.scene().objects.size(); ++i) turned.push_back(r.object(i).turnedInSolid);
  EXPECT_EQ(turned, GetParam().turned);
}
INSTANTIATE_TEST_SUITE_P(
    Shapes, NormalsOfAPrimitive,
    testing::Values(
        // The normal of every disk points to its own z, which is out of the cylinder at its top alone.
        Turned{"Cylinder 1 -1 1 360 Disk 1 1 360 Disk -1 1 360", {false, false, true}},
        Turned{"Disk -1 1 360 Disk 1 1 360 Cylinder 1 -1 1 360", {false, true, true}},
        Turned{"Cylinder 1 -1 1 360 Disk 1 1 360 ReverseOrientation Disk -1 1 360", {false, false, false}},
        Turned{"Cylinder 1 -1 1 360 Disk 1 1 360 Scale 1 1 -1 Disk 1 1 360", {false, false, false}},
        Turned{"Scale 1 1 -1 Cylinder 1 -1 1 360 Disk 1 1 360 Disk -1 1 360", {false, false, true}},
        // A coin, whose two rims lie within the tolerance of each other.
        Turned{"Cylinder 1 0 0.004 360 Disk 0.004 1 360 Disk 0 1 360", {false, false, true}},
        // Two shells that nothing joins each have a first object.
        Turned{"Cone 1 1 360 Disk 0 1 360 Translate 5 0 0 Disk 0 1 360 Cone 1 1 360", {false, true, false, true}},
        Turned{"Sphere 1 -1 1 360", {false}}));

TEST(Solids, OfWrongUseAreNamedAndMakeSomethingSensible) {
  const Reading r("SolidBegin \"union\" SolidEnd" +
                  inWorld("SolidBegin \"merge\"\nSphere 1 -1 1 360\nSolidBegin \"primitive\"\n"
                          "SolidBegin \"union\" Sphere 1 -1 1 360 SolidEnd SolidEnd SolidEnd\nSolidEnd"));
  EXPECT_EQ(r.codes(), "rib-solid@1 rib-solid@2 rib-solid@3 rib-solid@5 rib-unbalanced@6 ");
  ASSERT_EQ(r.scene().objects.size(), 2U);
  EXPECT_EQ(r.scene().solids.size(), 1U);
  EXPECT_NE(r.object(0).solidBlock, r.object(1).solidBlock);
}

TEST(Solids, AreCountedWhereTheyNestBeyondUse) {
  std::string rib;
  for (int i = 0; i < 1000; ++i) rib += "SolidBegin \"union\"\n";
  rib += "SolidBegin \"primitive\" Sphere 1 -1 1 360 SolidEnd ";
  for (int i = 0; i < 1000; ++i) rib += "SolidEnd ";
  const Reading r(inWorld(rib));
  EXPECT_NE(r.codes().find("rib-nesting@102 "), std::string::npos) << r.codes();
  ASSERT_EQ(r.scene().solids.size(), 1U);
  EXPECT_EQ(r.scene().solids[0].blockCount(), 101);  // the sphere is a primitive of its own
  EXPECT_EQ(r.scene().objects.size(), 1U);
}

TEST(Solids, StayAroundAttributesThatAreRestored) {
  const std::string save = "Resource \"a\" \"attributes\" \"string operation\" \"save\" ",
                    restore = "Resource \"a\" \"attributes\" \"string operation\" \"restore\" ";
  const Reading inside(inWorld(save + "SolidBegin \"primitive\" " + restore + kSphere + "SolidEnd"));
  EXPECT_EQ(inside.object(0).solid, 0);
  const Reading after(inWorld("SolidBegin \"primitive\" " + save + kSphere + "SolidEnd " + restore + kSphere));
  EXPECT_EQ(after.object(0).solid, 0);
  EXPECT_EQ(after.object(1).solid, -1);
}

}  // namespace
}  // namespace tomales
