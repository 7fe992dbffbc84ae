// Motion blocks, retained objects, archives, geometry requests.

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "rib_test_tools.h"

namespace tomales {
namespace {

TEST(Motion, MovesTransformations) {
  const Reading r("Shutter 0 1" +
                  inWorld("MotionBegin [0 1] Translate 0 0 0 Translate 4 0 0 MotionEnd Scale 2 2 2 " + kSphere));
  const vec3 p = transformPoint(r.object(0).worldFromObject.at(.25f), {1, 0, 0});
  EXPECT_FLOAT_EQ(p.x, 3);
}

TEST(Motion, RotateTurnsByItsAnglesWholeTurnsToo) {
  const Reading r("Shutter 0 1" + inWorld("MotionBegin [0 1] Rotate 0 0 0 1 Rotate 540 0 0 1 MotionEnd "
                                          "Translate 2 0 0 " +
                                          kSphere));
  for (const float t : {0.1f, 0.5f, 0.73f}) {
    const vec3 p = transformPoint(r.object(0).worldFromObject.at(t), vec3(0));
    EXPECT_NEAR(glm::length(p), 2, 0.01f);
    EXPECT_NEAR(p.x, 2 * std::cos(glm::radians(540 * t)), 0.01f) << t;
    EXPECT_NEAR(p.y, 2 * std::sin(glm::radians(540 * t)), 0.01f) << t;
  }
}

TEST(Motion, DeformsGeometry) {
  const Reading r("Shutter 0 1" + inWorld("MotionBegin [0 1] Sphere 1 -1 1 360 Sphere 2 -2 2 360 MotionEnd"));
  ASSERT_EQ(r.object(0).shapes.size(), 2u);
  EXPECT_EQ(r.object(0).shapeTimes, (std::vector<float>{0, 1}));
  const UvRect all;
  EXPECT_GT(r.object(0).shapes[1]->bound(0, all).size().x, 1.9f * r.object(0).shapes[0]->bound(0, all).size().x);
}

TEST(Motion, WhatGrowsFromNothingIsKeptAtAllKeys) {
  for (const char* keys :
       {"Sphere 0 0 0 360 Sphere 2 -2 2 360", "Sphere 2 -2 2 360 Sphere 0 0 0 360", "Sphere 2 -2 2 0 Sphere 2 -2 2 360",
        "Disk 0 0 360 Disk 0 2 360", "Hyperboloid 0 0 0 0 0 0 360 Hyperboloid 1 0 0 2 0 0 360"}) {
    const Reading r(std::string("Shutter 0 1") + inWorld(std::string("MotionBegin [0 1] ") + keys + " MotionEnd"));
    ASSERT_EQ(r.scene().objects.size(), 1u) << keys << r.codes();
    EXPECT_EQ(r.object(0).shapes.size(), 2u) << keys;
    EXPECT_TRUE(r.log.entries().empty()) << keys << r.codes();
  }
  for (const char* keys : {"Scale 0 0 0 Scale 1 1 1", "Scale 1 1 1 Scale 1 0 1",
                           "ConcatTransform [0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1] ConcatTransform [1 0 0 0 0 1 0 "
                           "0 0 0 1 0 0 0 0 1]"}) {
    const Reading r(std::string("Shutter 0 1") +
                    inWorld(std::string("MotionBegin [0 1] ") + keys + " MotionEnd " + kSphere));
    ASSERT_EQ(r.scene().objects.size(), 1u) << keys << r.codes();
    EXPECT_TRUE(r.log.entries().empty()) << keys << r.codes();
  }
  const Reading r(inWorld("MotionBegin [0 1] Scale 0 0 0 Scale 0 1 1 MotionEnd " + kSphere));
  EXPECT_EQ(r.log.count("rib-object-dropped"), 1) << "flat at all keys";
}

TEST(Motion, WhatIsNothingAtAKeyHasTheShapeOfTheNextKeyThatIsSomething) {
  const Reading r("Shutter 0 1" +
                  inWorld("MotionBegin [0 .5 1] Scale 1 1 1 Scale 0 0 0 Scale 2 4 8 MotionEnd " + kSphere +
                          "Identity MotionBegin [0 .5 1] Scale 1 2 3 Scale 0 0 0 Scale 0 0 0 "
                          "MotionEnd " +
                          kSphere));
  const auto shape = [&](size_t object, float time) {
    const mat4 m = r.object(object).worldFromObject.at(time);
    EXPECT_GT(m[0].x, 0);
    EXPECT_LT(m[2].z, 1e-4f) << "hardly to be seen";
    return vec3(m[0].x, m[1].y, m[2].z) / m[0].x;
  };
  expectNear(shape(0, 0.5f), {1, 2, 4});
  expectNear(shape(1, 0.5f), {1, 2, 3});
  expectNear(shape(1, 1), {1, 2, 3});
}

TEST(Motion, DisplacementIsBoundWhereWhatGrowsIsLargest) {
  const std::string bumpy = "Displacement \"bumpy\" Attribute \"displacementbound\" \"sphere\" [0.1] ";
  for (const char* keys : {"Scale 1 1 1 Scale 3 3 3", "Scale 3 3 3 Scale 1 1 1"}) {
    const Reading r(std::string("Shutter 0 1") +
                    inWorld(bumpy + "MotionBegin [0 1] " + keys + " MotionEnd " + kSphere));
    EXPECT_NEAR(r.object(0).displacementBound, 0.3f, 1e-6f) << keys;
  }
}

TEST(Displacement, IsBoundInTheSpaceThatIsNamed) {
  const std::pair<const char*, float> bounds[] = {
      {"object", 0.2f}, {"shader", 1.0f}, {"world", 0.5f}, {"camera", 0.5f}, {"named", 2.0f}};
  for (const auto& [space, bound] : bounds) {
    const Reading r(
        inWorld("TransformBegin Scale 4 4 4 CoordinateSystem \"named\" TransformEnd Scale 2 2 2 Displacement \"bumpy\" "
                "Attribute \"displacementbound\" \"float sphere\" [0.5] \"string coordinatesystem\" [\"" +
                std::string(space) + "\"] Scale 0.2 0.2 0.2 " + kSphere));
    EXPECT_NEAR(r.object(0).displacementBound, bound, 1e-6f) << space;
  }
}

TEST(Motion, KeepsTheFirstShapeWhereTopologiesDiffer) {
  const Reading r(
      inWorld("MotionBegin [0 1]\nPolygon \"P\" [0 0 0 1 0 0 0 1 0]\n"
              "PointsPolygons [3 3] [0 1 2 0 2 3] \"P\" [0 0 0 1 0 0 0 1 0 5 5 5]\nMotionEnd"));
  ASSERT_EQ(r.scene().objects.size(), 2u) << "different requests end the block: both are drawn";
  const Reading s(
      inWorld("MotionBegin [0 1]\nPointsPolygons [3] [0 1 2] \"P\" [0 0 0 1 0 0 0 1 0]\n"
              "PointsPolygons [3 3] [0 1 2 0 2 3] \"P\" [0 0 0 1 0 0 0 1 0 5 5 5]\nMotionEnd"));
  ASSERT_EQ(s.scene().objects.size(), 1u);
  EXPECT_EQ(s.object(0).shapes.size(), 1u);
  EXPECT_EQ(s.message("rib-motion").where.line, 4);
}

TEST(Motion, WithWrongTimesOrCountsUsesWhatFits) {
  const Reading r(inWorld("MotionBegin [1 0] Translate 1 0 0 Translate 2 0 0 MotionEnd " + kSphere +
                          "Identity MotionBegin [0 1] Translate 3 0 0 MotionEnd " + kSphere));
  EXPECT_FALSE(r.object(0).worldFromObject.moving());
  EXPECT_FLOAT_EQ(r.object(0).worldFromObject.at(0)[3].x, 1);
  EXPECT_FLOAT_EQ(r.object(1).worldFromObject.at(0)[3].x, 3);
  EXPECT_GE(r.log.count("rib-motion"), 2);
}

TEST(Motion, WithoutEndDoesNotSwallowTheScene) {
  const Reading r(inWorld("MotionBegin [0 1] Translate 1 0 0 Translate 2 0 0 " + kSphere + kSphere));
  ASSERT_EQ(r.scene().objects.size(), 2u);
  EXPECT_TRUE(r.object(1).worldFromObject.moving());
}

TEST(Objects, ShareTheirGeometryAndTakeTheAttributesOfTheInstance) {
  const Reading r(inWorld("ObjectBegin 1 " + kSphere + "AttributeBegin Color 0 0 1 Translate 0 1 0 " + kSphere +
                          "AttributeEnd ObjectEnd Color 1 0 0 Translate 1 0 0 ObjectInstance 1 Color 0 1 0 "
                          "Translate 1 0 0 ObjectInstance 1 " +
                          kSphere));
  ASSERT_EQ(r.scene().objects.size(), 5u);
  EXPECT_EQ(&r.object(0).shape(), &r.object(2).shape());
  EXPECT_EQ(&r.object(1).shape(), &r.object(3).shape());
  EXPECT_EQ(r.attributes(0).color, vec3(1, 0, 0));
  EXPECT_EQ(r.attributes(2).color, vec3(0, 1, 0));
  EXPECT_EQ(r.attributes(1).color, vec3(0, 0, 1)) << "what the master sets wins";
  EXPECT_EQ(r.attributes(3).color, vec3(0, 0, 1));
  EXPECT_EQ(r.object(3).worldFromObject.at(0)[3], vec4(2, 1, 0, 1));
  EXPECT_EQ(r.object(4).worldFromObject.at(0)[3], vec4(2, 0, 0, 1)) << "an instance leaves nothing behind";
}

TEST(Objects, KeepTheirPlaceOverIdentityAndTransformWithin) {
  const Reading r(inWorld("ObjectBegin 1 Identity " + kSphere + "ObjectEnd Translate 3 0 0 ObjectInstance 1"));
  EXPECT_EQ(r.object(0).worldFromObject.at(0)[3], vec4(3, 0, 0, 1));
}

TEST(Objects, BuildPatchesAnewUnderAnotherBasis) {
  std::string p;
  for (int i = 0; i < 16; ++i) p += std::to_string(i % 4) + " " + std::to_string(i / 4) + " 0 ";
  const Reading r(inWorld("ObjectBegin 1 Patch \"bicubic\" \"P\" [" + p +
                          "] ObjectEnd ObjectInstance 1 "
                          "Basis \"b-spline\" 1 \"b-spline\" 1 ObjectInstance 1 Basis [-1 3 -3 1 3 -6 3 0 -3 "
                          "3 0 0 1 0 0 0] 3 \"bezier\" 3 ObjectInstance 1"));
  const UvRect all;
  const auto width = [&](size_t i) { return r.object(i).shape().bound(0, all).size().x; };
  EXPECT_NEAR(width(0), 3, 1e-3);
  EXPECT_LT(width(1), 2);
  EXPECT_FLOAT_EQ(width(2), width(0)) << "the Bezier basis written out";
}

TEST(Objects, AreTubesWhereTheInstanceSaysSoAndRibbonsElsewhere) {
  const std::string round = "Attribute \"dice\" \"roundcurve\" ";
  const Reading r(inWorld("ObjectBegin 1 Curves \"linear\" [2] \"nonperiodic\" \"P\" [0 0 0 1 0 0] ObjectEnd " + round +
                          "[1] ObjectInstance 1 " + round + "[0] ObjectInstance 1 " + round + "[1] ObjectInstance 1"));
  const size_t patches[] = {3, 1, 3};
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(r.object(i).shape().patchCount(), patches[i]) << i;
}

TEST(Objects, StandForAMillionRequestsAtMost) {
  std::string many = "ObjectBegin 1\n", thousands = "ObjectBegin 2\n";
  for (int i = 0; i < 1000; ++i) {
    many += "Matte 1 ";
    thousands += "ObjectInstance 1 ";
  }
  const Reading r(inWorld(many + "ObjectEnd " + thousands + kSphere + "ObjectEnd\nObjectInstance 2\n" +
                          "ObjectBegin 3 ObjectInstance 1 Sphere 2 -2 2 360 ObjectEnd ObjectInstance 3 " + kSphere));
  ASSERT_EQ(r.scene().objects.size(), 2u) << "the sphere after the millionth request is left out";
  EXPECT_EQ(r.told("rib-nesting"), 1);
  EXPECT_EQ(r.message("rib-nesting").where.line, 6);
  EXPECT_TRUE(r.attributes(0).matte == false && r.attributes(1).matte == false) << "an instance leaves nothing behind";
}

TEST(Objects, WithoutTheirEndEndWhereAWorldBeginsOrTheFileEnds) {
  const std::string open = "ObjectBegin 1\nSphere 1 -1 1 360 ";
  const Reading r(open + "WorldBegin ObjectInstance 1 WorldEnd");
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.codes(), "rib-unbalanced@1 ");
  const Reading s("WorldBegin " + open);
  EXPECT_EQ(s.scenes.size(), 1u);
  EXPECT_EQ(s.codes(), "rib-unbalanced@1 rib-unbalanced@2 ") << "the world's end is missing, too";
}

TEST(Objects, ThatNameEachOtherEnd) {
  const Reading r(inWorld("ObjectBegin 1 " + kSphere + "ObjectInstance 1 ObjectInstance 1 ObjectEnd ObjectInstance 1"));
  EXPECT_GE(r.log.count("rib-nesting"), 1);
  EXPECT_GE(r.scene().objects.size(), 1u);
}

TEST(Objects, ThatAreUnknownAreMissing) {
  const Reading r(inWorld("ObjectInstance 5 " + kSphere));
  EXPECT_EQ(r.message("rib-unknown-object").severity, Severity::Missing);
  EXPECT_EQ(r.scene().objects.size(), 1u);
}

TEST(Geometry, IsBuiltFromEveryRequest) {
  const std::string square = "\"P\" [0 0 0  1 0 0  1 1 0  0 1 0]";
  const Reading r(
      inWorld("Sphere 1 -1 1 360 Cone 1 1 360 Cylinder 1 0 1 360 Hyperboloid 1 0 0 1 0 1 360 "
              "Paraboloid 1 0 1 360 Disk 0 1 360 Torus 2 1 0 360 360 Polygon " +
              square + " GeneralPolygon [4] " + square + " PointsPolygons [4] [0 1 2 3] " + square +
              " PointsGeneralPolygons [1] [4] [0 1 2 3] " + square +
              " Patch \"bilinear\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 0] PatchMesh \"bilinear\" 3 \"nonperiodic\" "
              "2 \"nonperiodic\" "
              "\"P\" [0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0] SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] "
              "[\"interpolateboundary\"] [0 0] [] [] " +
              square));
  EXPECT_EQ(r.codes(), "");
  ASSERT_EQ(r.scene().objects.size(), 14u);
  EXPECT_EQ(r.object(12).shape().patchCount(), 2u);
}

class Archives : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_ + "/sub"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ + "/" + name) << text;
    return folder_ + "/" + name;
  }
  std::vector<Scene> read(const std::vector<std::string>& files) {
    std::vector<Scene> scenes;
    RibSettings settings;
    settings.onScene = [&](Scene&& s) { scenes.push_back(std::move(s)); };
    good_ = readRib(files, settings, log_);
    return scenes;
  }
  const std::string folder_ = testing::TempDir() + "tomales_archives";
  Log log_{Log::Verbosity::Quiet};
  bool good_ = false;
};

TEST_F(Archives, AreFoundBesideTheFileThatReadsThem) {
  write("sub/ball.rib", kSphere);
  write("sub/scene.rib", "ReadArchive \"ball.rib\"\n");
  const auto scenes = read({write("main.rib", inWorld("ReadArchive \"sub/scene.rib\""))});
  EXPECT_EQ(scenes.at(0).objects.size(), 1u);
  EXPECT_NE(scenes[0].objects[0].where.text().find("ball.rib:1"), std::string::npos);
}

TEST_F(Archives, AreFoundInTheSearchPath) {
  write("sub/ball.rib", kSphere);
  const auto scenes = read({write("main.rib", "Option \"searchpath\" \"archive\" \"/none:" + folder_ + "/sub\"" +
                                                  inWorld("ReadArchive \"ball.rib\""))});
  EXPECT_EQ(scenes.at(0).objects.size(), 1u);
}

TEST_F(Archives, ThatReadThemselvesAreStopped) {
  write("a.rib", kSphere + "ReadArchive \"b.rib\"");
  write("b.rib", "ReadArchive \"a.rib\"");
  const auto scenes = read({write("main.rib", inWorld("ReadArchive \"a.rib\""))});
  EXPECT_TRUE(good_);
  EXPECT_EQ(scenes.at(0).objects.size(), 1u);
  EXPECT_EQ(log_.count("rib-archive-recursion"), 1);
}

TEST_F(Archives, ThatAreMissingAreReportedAndTheRestIsRead) {
  const auto scenes = read({write("main.rib", inWorld("ReadArchive \"none.rib\"\n" + kSphere))});
  EXPECT_TRUE(good_);
  EXPECT_EQ(scenes.at(0).objects.size(), 1u);
  EXPECT_EQ(log_.worst(), Severity::Missing);
  EXPECT_EQ(log_.entries()[0].where.line, 2);
}

TEST_F(Archives, SeveralFilesAreOneStream) {
  const auto scenes = read({write("head.rib", "Format 12 12 1 Declare \"my\" \"float\"\n"),
                            write("body.rib", inWorld("Surface \"x\" \"my\" 3 " + kSphere))});
  EXPECT_EQ(scenes.at(0).options.xResolution, 12);
  EXPECT_EQ(scenes[0].objects.at(0).attributes->surface->params.size(), 1u);
}

TEST_F(Archives, FilesThatCannotBeOpenedFailButTheOthersAreRead) {
  const auto scenes = read({folder_ + "/none.rib", write("b.rib", inWorld(kSphere))});
  EXPECT_FALSE(good_);
  EXPECT_EQ(scenes.size(), 1u);
  EXPECT_EQ(log_.worst(), Severity::Error);
}

TEST(Objects, ShareTheShapesOfTheirMasterWhateverItsTagsAre) {
  const Reading r(
      inWorld("ObjectBegin 1 SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"interpolateboundary\"] [1 0] [1] []"
              " \"P\" [0 0 0 1 0 0 1 1 0 0 1 0] ObjectEnd ObjectInstance 1 ObjectInstance 1"));
  ASSERT_EQ(r.scene().objects.size(), 2u);
  EXPECT_EQ(r.object(0).shapes, r.object(1).shapes);
}

TEST(Motion, OfShapesOfWhichALaterOneDiffersKeepsTheFirstAlone) {
  const std::string triangle = "Polygon \"P\" [0 0 0 1 0 0 1 1 0]\n",
                    hexagon = "Polygon \"P\" [0 0 0 1 0 0 2 1 0 2 2 0 1 2 0 0 1 0]\n";
  const Reading r(inWorld("MotionBegin [0 0.5 1]\n" + triangle + triangle + hexagon + "MotionEnd"));
  EXPECT_EQ(r.codes(), "rib-motion@5 ");
  EXPECT_EQ(r.object(0).shapes.size(), 1u);
  EXPECT_EQ(r.object(0).shapeTimes.size(), 1u);
}

}  // namespace
}  // namespace tomales
