// bake3d() and texture3d() between shaders and what keeps the points: spaces, radii, masks, and what is baked once.
#include "tests/unit/shade/cloud_calls.h"

namespace tomales {
namespace {

TEST_F(CloudCalls, PointsAreBakedInTheSpaceOfTheFileWithTheRadiusOfTheirMicropolygons) {
  surface("baking");
  worldFromObject = Motion::still(mat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1));
  system().setClouds(&clouds);
  shade(row());
  ASSERT_EQ(clouds.baked.size(), 2u) << "those under the mask";
  EXPECT_EQ(clouds.baked[1].P, vec3(0.5f, 0, 2.5f));
  EXPECT_EQ(clouds.baked[1].N, vec3(0, 0, -1));
  EXPECT_FLOAT_EQ(clouds.baked[1].radius, 2.5f) << "half of a 6 by 8 diagonal, in object space";
  EXPECT_EQ(clouds.baked[1].value, 0.25f);
}

TEST_F(CloudCalls, NothingIsBakedOrFoundWhereNoFileIsNamed) {
  for (const char* shader : {"baking", "finding"}) {
    surface(shader, {text("file", "")});
    system().setClouds(&clouds);
    shade(row());
    shading.reset();
  }
  EXPECT_TRUE(clouds.baked.empty());
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(CloudCalls, EachPointIsBakedOnceForTheCameraAlone) {
  surface("bakingwide", {text("file", "left.ptc")});
  light("distantlight", {text("__group", "key")});
  system().setClouds(&clouds);
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  shade(row(), gather);
  EXPECT_TRUE(clouds.baked.empty());
  shade(withSteps(row()));
  EXPECT_EQ(clouds.baked.size(), 2u) << "neighbours are not points of their own";
}

TEST_F(CloudCalls, WhatIsFoundIsSaidPointByPointUnderTheMask) {
  surface("finding");
  system().setClouds(&clouds);
  const ShadedPoints out = shade(row());
  expectColor(out.color(0), {-1, 0, 7});
  expectColor(out.color(1), {1, 1, 7});
  expectColor(out.color(2), {2, 1, 7});
  expectColor(out.color(3), {-1, -1, 7});
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(CloudCalls, DiffusedLightIsAskedForInTheSpaceOfTheFileUnderTheMask) {
  surface("wax");
  worldFromObject = Motion::still(mat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1));
  system().setClouds(&clouds);
  const ShadedPoints out = shade(row());
  expectColor(out.color(0), {0, 15, 8});
  expectColor(out.color(1), {0.5f, 15, 8});
  expectColor(out.color(3), {-1, -1, -1});
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(CloudCalls, TheBuiltInBodyAsksByItsMaterialAndWithoutOneByItsColours) {
  ParamList params{text("cloudname", "known.ptc"), number("unitlength", 10), number("eta", 1.5f), number("Ks", 0)};
  attributes.color = vec3(1, 2, 1);
  surface("subsurface", params);
  system().setClouds(&clouds);
  expectColor(shade(row()).color(1), {1, 2 * 15, 0});
  params.push_back(text("material", ""));
  params.push_back(color("albedo", {0.2f, 0.5f, 0.3f}));
  params.push_back(color("meanfreepath", {1, 2, 4}));
  shading.reset();
  scene.objects.clear();
  surface("subsurface", params);
  system().setClouds(&clouds);
  expectColor(shade(row()).color(1), {1, 2 * 15, 0.5f * 4});
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(CloudCalls, ABodyBakesWhatEntersForLaterFrames) {
  light("ambientlight");
  light("distantlight", {point("to", {0, 0, 1})});
  surface("subsurface", {text("cloudname", "entering.ptc"), number("baking", 1)});
  system().setClouds(&clouds);
  shade(row());
  EXPECT_EQ(clouds.baked.size(), row().count());
}

TEST_F(CloudCalls, GiveNeighboursWhatTheirPointFinds) {
  surface("copying");
  system().setClouds(&clouds);
  shade(withSteps(points({vec3(1, 0, 5), vec3(2, 0, 5), vec3(3, 0, 5)})));
}

TEST_F(CloudCalls, TellWhetherTheyKnowTheirFile) {
  surface("answering");
  system().setClouds(&clouds);
  for (const int known : {1, 0}) {
    cloudFile = known ? "known.ptc" : "absent.ptc";
    shade(row());
    EXPECT_EQ(answers, std::vector<int32_t>(5, known));
  }
}

TEST_F(CloudCalls, WithoutItsCloudNoLightIsDiffusedAndTheUserIsTold) {
  surface("wax", {text("file", "absent.ptc")});
  system().setClouds(&clouds);
  expectColor(shade(row()).color(0), {0, 0, 0});
  EXPECT_EQ(log.worst(), Severity::Missing);
}

TEST_F(CloudCalls, CausticsAreThePhotonsOfTheMapThatTheAttributeNames) {
  attributes.photon.causticMap = "caustics.ptc";
  surface("causticlight");
  system().setClouds(&clouds);
  expectColor(shade(row()).color(0), {50, -1, 0});
}

TEST_F(CloudCalls, WithoutAMapThereAreNoCaustics) {
  surface("causticlight");
  system().setClouds(&clouds);
  expectColor(shade(row()).color(0), {0, 0, 0});
}

TEST_F(CloudCalls, ASpaceOfThePictureIsNoSpaceOfAFile) {
  surface("finding", {text("file", "known.ptc"), text("space", "raster")});
  system().setClouds(&clouds);
  shade(row());
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_NE(log.entries()[0].message.find("there is no coordinate system \"raster\""), std::string::npos)
      << log.entries()[0].message;
}

TEST_F(CloudCalls, WhatCannotBeIsReportedOnceWithShaderAndFile) {
  surface("finding", {text("file", "absent.ptc")});
  system().setClouds(&clouds);
  shade(row());
  shade(row());
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_NE(log.entries()[0].message.find("\"absent.ptc\": is not there"), std::string::npos)
      << log.entries()[0].message;
  EXPECT_EQ(log.worst(), Severity::Missing);
}

}  // namespace
}  // namespace tomales
