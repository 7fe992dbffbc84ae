// What is said of lamps that come to nothing, and of lamps that are too bright.
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

class LightUses : public Stage {
 protected:
  LightUses() {
    surface("matte");
    attributes.color = vec3(0.5f);
  }
  /// A lamp that shines along z, onto points that face the eye, with this brightness on white paper.
  LightCall& sun(float brightness, const vec3& to = {0, 0, 1}) {
    return light("distantlight", {number("intensity", brightness), point("from", vec3(0)), point("to", to)});
  }
  void shadePaper(int facing, int away = 0, const ShadeContext& context = {}) {
    ShadePoints p = points(std::vector<vec3>(static_cast<size_t>(facing + away), vec3(0, 0, 5)));
    for (int i = facing; i < facing + away; ++i) {  // they see the lamp from behind, through a sheet seen by its back
      p.set3(kNx, i, {1, 0, 0});
      p.set3(kNgx, i, {1, 0, 0});
      p.set3(kIx, i, {-1, 0, 0});
    }
    shade(p, context);
  }
  std::string said(const std::string& code) {
    system().warnOfLightNoise();
    for (const LogEntry& e : log.entries())
      if (e.code == code) return e.message;
    return "";
  }
};

TEST_F(LightUses, GlareBeginsAtSixteenTimesWhite) {
  sun(16);
  shadePaper(320);
  EXPECT_NE(said("light-glare").find("at least 16 times"), std::string::npos) << said("light-glare");
}

TEST_F(LightUses, GlareIsNamedByThePowerOfTwoBelow) {
  sun(63);
  shadePaper(320);
  EXPECT_NE(said("light-glare").find("at least 32 times"), std::string::npos) << said("light-glare");
}

TEST_F(LightUses, LightOfThePictureIsNoGlare) {
  sun(15.9f);
  shadePaper(320);
  EXPECT_EQ(said("light-glare"), "");
}

TEST_F(LightUses, ExposureCountsForGlare) {
  scene.options.exposureGain = 2;
  sun(8);
  shadePaper(320);
  EXPECT_NE(said("light-glare").find("at least 16 times"), std::string::npos);
}

TEST_F(LightUses, AShortExposureShowsABrightLamp) {
  scene.options.exposureGain = 0.5f;
  sun(31);
  shadePaper(320);
  EXPECT_EQ(said("light-glare"), "");
}

TEST_F(LightUses, AFullSunInMostOfThePictureIsGlareAndInHalfOfItNot) {
  sun(100);
  shadePaper(160, 160);
  EXPECT_EQ(said("light-glare"), "") << "half of the points";
  shadePaper(32);
  EXPECT_NE(said("light-glare"), "") << "more than half of them";
}

TEST_F(LightUses, FewPointsAreNoPicture) {
  sun(100);
  shadePaper(9 * 16);
  EXPECT_EQ(said("light-glare"), "");
  shadePaper(16);
  EXPECT_NE(said("light-glare"), "");
}

TEST_F(LightUses, TheFirstPointOfEveryBatchCounts) {
  sun(100);
  for (int batch = 0; batch < 10; ++batch) shadePaper(1);
  EXPECT_NE(said("light-glare"), "");
}

TEST_F(LightUses, OfSeveralSamplesTheSumCounts) {
  scene.options.displays.clear();
  services.emitter = [](float a, float b, vec3& P, vec3& N, float& area) {
    P = {0.02f * (a - 0.5f), 0.02f * (b - 0.5f), 4};  // small, and one away from the paper
    N = {0, 0, 1};
    area = 4e-4f;
  };
  // E/pi is radiance times area over pi: 16 exactly, less what the lamp's edges are slanted by.
  light("arealight", {color("lightcolor", vec3(1)), number("intensity", 16.5f * kPi / 4e-4f), number("samples", 4)},
        true);
  shadePaper(320);
  EXPECT_NE(said("light-glare").find("at least 16 times"), std::string::npos) << said("light-glare");
}

TEST_F(LightUses, ALampWithoutLightIsNamed) {
  sun(0);
  shadePaper(1);
  EXPECT_NE(said("light-useless").find("sends no light"), std::string::npos);
}

TEST_F(LightUses, ALampBehindEverythingIsNamed) {
  sun(1, {0, 0, -1});
  shadePaper(1);
  EXPECT_NE(said("light-useless").find("faces away"), std::string::npos) << said("light-useless");
}

TEST_F(LightUses, ALampWhoseShadowCoversAllIsNamed) {
  sun(1).castsShadows = true;
  services.visible = [](const vec3&, const vec3&) { return 0.0f; };
  shadePaper(1);
  EXPECT_NE(said("light-useless").find("lies in its shadow"), std::string::npos) << said("light-useless");
}

TEST_F(LightUses, ALampInItsOwnShadowIsNamedWithTheSmallestObjectAroundIt) {
  light("pointlight", {point("from", {0, 0, 3})}).castsShadows = true;
  services.visible = [](const vec3&, const vec3&) { return 0.0f; };
  Problems problems;
  // The largest is the ground of the test's points. The last is smaller, and beside the lamp.
  for (const auto& [name, radius, x] : {std::tuple{"house", 9.0f, 0.0f}, std::tuple{"bulb", 0.5f, 0.1f},
                                        std::tuple{"shade", 0.7f, 0.0f}, std::tuple{"stand", 0.2f, 0.3f}}) {
    Object o;
    Attributes a = attributes;
    a.name = name;
    o.shapes = {makeSphere(radius, -radius, radius, 360, {}, problems)};
    o.attributes = std::make_shared<const Attributes>(a);
    mat4 place(1.0f);
    place[3] = {x, 0, 3, 1};
    o.worldFromObject = Motion::still(place);
    scene.objects.push_back(o);
  }
  shadePaper(1);
  EXPECT_NE(said("light-useless").find("lies in its shadow; it stands within the bounds of \"bulb\""),
            std::string::npos)
      << said("light-useless");
}

TEST_F(LightUses, WhatGlowsLightsAWorldOfIndirectLight) {
  light("indirectlight");
  system();
  Attributes glowing = attributes;
  glowing.surface = std::make_shared<const ShaderCall>(call("constant", {}));
  Object glow = scene.objects[0];
  glow.attributes = std::make_shared<const Attributes>(glowing);
  scene.objects.push_back(glow);
  scene.freeze();
  shading = std::make_unique<ShadingSystem>(scene, registry, &services, log, stats);
  shadePaper(1);
  EXPECT_EQ(said("light-none"), "");
}

TEST_F(LightUses, IndirectLightAloneIsDark) {
  light("indirectlight");
  shadePaper(1);
  EXPECT_NE(said("light-none"), "");
}

TEST_F(LightUses, ALampIsOfUseWhereItComesToOnePoint) {
  sun(1).castsShadows = true;
  services.visible = [](const vec3& P, const vec3&) { return P.x > 0 ? 1.0f : 0.0f; };
  shade(points({vec3(-1, 0, 5), vec3(-2, 0, 5), vec3(1, 0, 5)}));
  EXPECT_EQ(said("light-useless"), "");
}

TEST_F(LightUses, AmbientLightComesEverywhere) {
  light("ambientlight");
  shadePaper(1);
  EXPECT_EQ(said("light-useless"), "");
}

TEST_F(LightUses, ACutPictureTellsNothingOfWhatALampIsFor) {
  scene.options.cropWindow = {0, 0.5f, 0, 1};
  sun(0);
  shadePaper(1);
  EXPECT_EQ(said("light-useless"), "");
}

TEST_F(LightUses, WhatALampSendsElsewhereMayComeBack) {
  sun(0);
  light("indirectlight");
  shadePaper(1);
  EXPECT_EQ(said("light-useless"), "");
}

TEST_F(LightUses, HitsOfRaysSketchesAndRehearsalsTellNothing) {
  sun(100);
  ShadeContext hit, sketch, rehearsal;
  hit.kind = RayKind::Diffuse;
  sketch.purpose = Purpose::Sketch;
  rehearsal.purpose = Purpose::Rehearsal;
  for (const ShadeContext& context : {hit, sketch, rehearsal}) shadePaper(320, 0, context);
  EXPECT_EQ(said("light-glare"), "");
}

TEST_F(LightUses, AWorldWithoutLightIsTold) {
  shadePaper(1);
  EXPECT_NE(said("light-none").find("\"thing\""), std::string::npos) << said("light-none");
  EXPECT_EQ(said("light-off"), "");
}

TEST_F(LightUses, AnObjectWithoutLightInALitWorldIsTold) {
  sun(1);
  attributes.lights.clear();
  shadePaper(1);
  EXPECT_NE(said("light-off").find("\"thing\""), std::string::npos) << said("light-off");
  EXPECT_EQ(said("light-none"), "");
}

TEST_F(LightUses, AShaderThatAsksForNoLightMayBeInTheDark) {
  surface("constant");
  shadePaper(1);
  EXPECT_EQ(said("light-none"), "");
}

}  // namespace
}  // namespace tomales
