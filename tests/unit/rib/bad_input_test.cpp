// Every kind of broken RIB gets a located message; whatever else is in the file is still there.
#include "rib_test_tools.h"

namespace tomales {
namespace {

TEST(BadInput, WithoutAnyRequestIsAnError) {
  for (const std::string& text :
       {std::string(), std::string("# only a comment\n"), std::string("hello world, 1 2 3"),
        std::string("\x7f\x45LF\x01\x01\0\0\0\x80\xff\xfe", 12), std::string("\x1f\x8b\x08garbage")}) {
    const Reading r(text);
    EXPECT_FALSE(r.good);
    EXPECT_EQ(r.log.worst(), Severity::Error);
    EXPECT_EQ(r.message("rib-empty").where.text(), "test.rib");
  }
}

TEST(BadInput, WithoutWorldEndRendersWhatThereIs) {
  const Reading r("FrameBegin 1 WorldBegin\n" + kSphere + "Polygon \"P\" [0 0 0 1 0");
  EXPECT_TRUE(r.good);
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.log.count("rib-arguments"), 1);
  EXPECT_EQ(r.log.count("rib-unbalanced"), 1);
}

TEST(BadInput, JunkBetweenRequestsCostsNothingElse) {
  const Reading r(inWorld(kSphere + std::string("\xd1\xff\0 ]] 3 \"x\n", 12) + kSphere));
  EXPECT_EQ(r.scene().objects.size(), 1u) << "an unclosed string eats the rest";
  const Reading s(inWorld(kSphere + std::string("\xd1\xff\0 ]] 3 \"x\"\n", 13) + kSphere));
  EXPECT_EQ(s.scene().objects.size(), 2u);
  EXPECT_EQ(s.message("rib-junk").where.line, 3);
}

TEST(BadInput, ObjectsThatCannotBeDrawnAreDroppedByName) {
  const char* bad[] = {"Sphere nan -1 1 360",
                       "Cylinder 1e999 0 1 360",
                       "Polygon \"P\" [0 0 nan 1 0 0 0 1 0]",
                       "Polygon \"P\" [0 0 inf 1 0 0 0 1 0]",
                       "Polygon \"Cs\" [0 0 0]",
                       "PointsPolygons [3] [0 1 7] \"P\" [0 0 0 1 0 0 0 1 0]",
                       "PointsPolygons [4] [0 1 2] \"P\" [0 0 0 1 0 0 0 1 0]",
                       "PointsPolygons [-3] [0 1 2] \"P\" [0 0 0 1 0 0 0 1 0]",
                       "SubdivisionMesh \"catmull-clark\" [3] [0 1 -2] \"P\" [0 0 0 1 0 0 0 1 0]",
                       "SubdivisionMesh \"nonsense\" [3] [0 1 2] \"P\" [0 0 0 1 0 0 0 1 0]",
                       "PatchMesh \"bicubic\" 1e9 \"nonperiodic\" 1e9 \"nonperiodic\" \"P\" [0 0 0]",
                       "Patch \"cubic\" \"P\" [0 0 0]",
                       "PointsGeneralPolygons [2000000000] [3] [0 1 2] \"P\" [0 0 0 1 0 0 0 1 0]"};
  for (const char* text : bad) {
    const Reading r(inWorld(kSphere + "Attribute \"identifier\" \"name\" \"culprit\"\n" + text + "\n" + kSphere));
    EXPECT_EQ(r.scene().objects.size(), 2u) << text;
    const LogEntry e = r.message("rib-object-dropped");
    EXPECT_NE(e.message.find("culprit"), std::string::npos) << text << ": " << r.codes();
    EXPECT_EQ(e.where.line, 4) << text;
    EXPECT_EQ(e.severity, Severity::Missing);
  }
}

TEST(BadInput, QuadricsWithoutAreaLeaveNothingOut) {
  for (const char* text : {"Sphere 0 -1 1 360", "Sphere 1 -1 1 0", "Disk 0 0 360", "Cone 1 0 360", "Cylinder 1 2 2 360",
                           "Torus 1 0 0 360 360", "Paraboloid 1 2 2 360", "Hyperboloid 1 2 3 1 2 3 360"}) {
    const Reading r(inWorld(std::string(text) + "\n" + kSphere));
    EXPECT_EQ(r.scene().objects.size(), 1u) << text;
    const LogEntry e = r.message("rib-no-area");
    EXPECT_EQ(e.severity, Severity::Warning) << text;
    EXPECT_EQ(e.where.line, 2) << text;
    EXPECT_EQ(r.log.entries().size(), 1u) << text << r.codes();
  }
}

TEST(BadInput, PolygonsWithoutAreaOrVerticesLeaveNothing) {
  for (const char* text : {"Polygon \"P\" [0 0 0 1 0 0]", "Polygon \"P\" []", "PointsPolygons [] [] \"P\" []"}) {
    const Reading r(inWorld(std::string(text) + "\n" + kSphere));
    EXPECT_EQ(r.scene().objects.size(), 1u) << text;
    EXPECT_EQ(r.log.entries().at(0).where.line, 2) << text;
  }
}

TEST(BadInput, SingularAndInfiniteTransformationsDropTheirObjects) {
  for (const char* text : {"Scale 0 1 1", "Scale 1e30 1e30 1e30 Scale 1e30 1e30 1e30"}) {
    const Reading r(inWorld(std::string("AttributeBegin ") + text + " " + kSphere + "AttributeEnd " + kSphere));
    EXPECT_EQ(r.scene().objects.size(), 1u) << text;
    EXPECT_EQ(r.log.count("rib-object-dropped"), 1) << text;
  }
  const Reading r(inWorld("Translate nan 0 0 Rotate 30 0 0 0 Skew 90 0 1 0 0 1 0 " + kSphere));
  EXPECT_EQ(r.object(0).worldFromObject.at(0), mat4(1));
  EXPECT_EQ(r.log.entries().size(), 3u) << r.codes();
}

TEST(BadInput, WhatIsCollapsedToAPointOrALineIsNotDrawnAndNothingIsMissing) {
  for (const char* text : {"Scale 0 0 0", "Scale 0 0 2"}) {
    const Reading r(
        inWorld(std::string("AttributeBegin ") + text + " " + kSphere + kSphere + "AttributeEnd " + kSphere));
    EXPECT_EQ(r.scene().objects.size(), 1u) << text;
    EXPECT_EQ(r.told("rib-collapsed"), 1) << text;
    EXPECT_EQ(r.log.worst(), Severity::Warning) << text;
  }
}

TEST(BadInput, SingularCamerasBecomeIdentity) {
  const Reading r("Scale 0 0 0" + inWorld(kSphere));
  EXPECT_EQ(r.log.count("rib-camera"), 1);
  EXPECT_EQ(r.scene().cameraFromWorldAtOpen(), mat4(1));
}

TEST(BadInput, HugeAndSenselessOptionsAreClampedOrRefused) {
  const Reading r(
      "Format 1e9 1e9 1\nPixelSamples 1e9 -3\nCropWindow .5 .5 0 1\nClipping 5 1\nShutter 1 0\nPixelFilter "
      "\"box\" 0 0\n"
      "Projection \"perspective\" \"fov\" 180\nExposure 1 0\nOption \"limits\" \"bucketsize\" [-5 "
      "1000000]\nFormat nan 1 1\n" +
      inWorld(""));
  const Options& o = r.scene().options;
  EXPECT_EQ(r.message("rib-option").where.line, 1);
  EXPECT_EQ(r.message("rib-clamped").where.line, 2);
  EXPECT_EQ(o.xResolution, 640);
  EXPECT_TRUE(o.xSamples <= 256 && o.ySamples == 1 && o.cropWindow[1] == 1 && o.nearClip < o.farClip);
  EXPECT_TRUE(o.shutterOpen <= o.shutterClose && o.xFilterWidth == 2 && o.fov_degrees == 90 && o.exposureGamma == 1);
  EXPECT_TRUE(o.bucketWidth == 1 && o.bucketHeight <= 4096);
  EXPECT_EQ(r.log.count("rib-option"), 7) << r.codes();
  EXPECT_EQ(r.log.count("rib-not-finite"), 1);
}

TEST(BadInput, UnbalancedBlocksAreReportedAndRepaired) {
  const Reading r(
      inWorld("AttributeEnd TransformEnd MotionEnd ObjectEnd FrameEnd\nAttributeBegin\nTransformBegin Color "
              "1 0 0\nAttributeEnd " +
              kSphere));
  EXPECT_EQ(r.scenes.size(), 1u);
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.attributes(0).color, vec3(1));
  EXPECT_GE(r.log.count("rib-unbalanced"), 5);
  const Reading s("FrameEnd WorldEnd FrameBegin 1" + inWorld("WorldBegin " + kSphere + "AttributeBegin") +
                  "WorldEnd FrameEnd");
  EXPECT_EQ(s.scenes.size(), 1u);
}

TEST(BadInput, DeepNestingEndsWhereItBegan) {
  std::string text = "WorldBegin\n";
  for (int i = 0; i < 30000; ++i) text += "AttributeBegin Translate 1 0 0\n";
  for (int i = 0; i < 30000; ++i) text += "AttributeEnd\n";
  const Reading r(text + kSphere + "WorldEnd");
  EXPECT_EQ(r.object(0).worldFromObject.at(0), mat4(1));
  EXPECT_GE(r.log.count("rib-nesting"), 1);
}

TEST(BadInput, BlocksThatWereTooDeepInOneWorldDoNotCountInTheNext) {
  std::string deep = "WorldBegin ";
  for (int i = 0; i < 10010; ++i) deep += "AttributeBegin ";
  const Reading r(deep + "WorldEnd\nWorldBegin AttributeEnd " + kSphere + "WorldEnd\n");
  EXPECT_GE(r.log.count("rib-nesting"), 1);
  bool told = false;
  for (const LogEntry& e : r.log.entries()) told |= e.message.starts_with("AttributeEnd without");
  EXPECT_TRUE(told);
}

TEST(BadInput, UnsupportedRequestsAreNamedOnce) {
  const Reading r(
      inWorld("VPAtmosphere \"fog\"\nVPAtmosphere \"fog\"\nVPSurface \"matte\"\nVPSurface \"matte\"\nVolume \"cloud\" "
              "[0 1 0 1 0 1] [0 0 0]\n" +
              kSphere));
  EXPECT_EQ(r.told("rib-unsupported"), 2);
  EXPECT_EQ(r.log.worst(), Severity::Missing);
  EXPECT_EQ(r.scene().objects.size(), 1u);
}

TEST(BadInput, ParametersThatAreNotNumbersAreIgnored) {
  const Reading r(
      inWorld("Surface \"matte\" \"Kd\" [nan] \"Ka\" .5\nColor nan 0 0\nAttribute \"trace\" \"bias\" []\n"
              "Polygon \"P\" [0 0 0 1 0 0 0 1 0] \"s\" [nan 1 2]"));
  EXPECT_EQ(r.attributes(0).surface->params.size(), 1u);
  EXPECT_EQ(r.attributes(0).color, vec3(1));
  EXPECT_FALSE(r.attributes(0).trace.bias);
  EXPECT_TRUE(r.object(0).shape().primvars().empty());
}

TEST(BadInput, LateOptionsCountForTheirWorldOnly) {
  const Reading r(inWorld("Format 16 16 1 Projection \"perspective\"") + inWorld(""));
  EXPECT_EQ(r.scenes.at(0).options.xResolution, 16);
  EXPECT_EQ(r.scenes[0].options.projection, ProjectionKind::Orthographic);
  EXPECT_EQ(r.scenes.at(1).options.xResolution, 640);
}

TEST(BadInput, AFileThatIsNotThereIsAnError) {
  Log log{Log::Verbosity::Quiet};
  EXPECT_FALSE(readRib({"/nowhere/scene.rib"}, {}, log));
  ASSERT_EQ(log.count("rib-open"), 1);
  EXPECT_EQ(log.entries()[0].severity, Severity::Error);
  EXPECT_EQ(*log.entries()[0].where.file, "/nowhere/scene.rib");
}

}  // namespace
}  // namespace tomales
