// Tests the tables of requests of the RIS era against the requests that they stand for, and the sun against the sky.
#include "rib_test_tools.h"

namespace tomales {
namespace {

TEST(RisTable, ValuesOfOptionsAndAttributesAreTheRequestsThatTheyReplace) {
  const Reading r(
      "Option \"Ri\" \"int[2] FormatResolution\" [32 24] \"float FormatPixelAspectRatio\" [2] \"float "
      "FrameAspectRatio\" "
      "[1.5] \"float[4] ScreenWindow\" [-1 1 -2 2] \"float[4] CropWindow\" [0 .5 0 1] \"float[2] Clipping\" [2 9] "
      "\"float[2] Shutter\" [1 3] \"string PixelFilterName\" [\"box\"] \"float[2] PixelFilterWidth\" [3 4]\n" +
      inWorld(
          "Attribute \"Ri\" \"color Color\" [1 2 3] \"color Opacity\" [.1 .2 .3] \"int Matte\" [1] \"int Sides\" [1] "
          "\"float ShadingRate\" [5] \"string Orientation\" [\"inside\"] " +
          kSphere + "Attribute \"Ri\" \"int ReverseOrientation\" [1] " + kSphere +
          "Attribute \"Ri\" \"int ReverseOrientation\" [0] " + kSphere + "Attribute \"Ri\" \"float[2] Sides\" [1 2]"));
  const Options& o = r.scene().options;
  EXPECT_TRUE(o.xResolution == 32 && o.yResolution == 24 && o.pixelAspect == 2 && o.frameAspect == 1.5f);
  EXPECT_EQ(o.screenWindow, (std::array<float, 4>{-1, 1, -2, 2}));
  EXPECT_EQ(o.cropWindow, (std::array<float, 4>{0, .5f, 0, 1}));
  EXPECT_TRUE(o.nearClip == 2 && o.farClip == 9 && o.shutterOpen == 1 && o.shutterClose == 3);
  EXPECT_TRUE(o.filter == "box" && o.xFilterWidth == 3 && o.yFilterWidth == 4);
  const Attributes& a = r.attributes(0);
  EXPECT_TRUE(a.color == vec3(1, 2, 3) && a.opacity == vec3(.1f, .2f, .3f) && a.matte && a.sides == 1);
  EXPECT_TRUE(a.shadingRate == 5 && a.insideOut && !r.attributes(1).insideOut && !r.attributes(2).insideOut);
  EXPECT_EQ(r.codes(), "rib-unknown-attribute@6 ") << "Sides is one number";
  const Options filter = Reading("Option \"Ri\" \"string PixelFilterName\" [\"box\"] " + inWorld("")).scene().options;
  EXPECT_TRUE(filter.filter == "box" && filter.xFilterWidth == 2 && filter.yFilterWidth == 2);
  EXPECT_EQ(Reading("Option \"Ri\" \"float[2] PixelFilterWidth\" [3 4]" + inWorld("")).codes(),
            "rib-unknown-option@1 ");
  EXPECT_EQ(
      Reading("Option \"Ri\" \"string PixelFilterName\" \"box\" \"float PixelFilterWidth\" 3" + inWorld("")).codes(),
      "rib-unknown-option@1 rib-unknown-option@1 ");
}

TEST(RisTable, ABasisByNameHasItsOwnStep) {
  std::string p;
  for (int i = 0; i < 7; ++i) p += std::to_string(i) + " 0 0 ";
  const std::pair<const char*, uint32_t> rows[] = {{"bezier", 2}, {"b-spline", 4}, {"catmull-rom", 4}};
  for (const auto& [basis, segments] : rows) {
    const Reading r(inWorld("Attribute \"Ri\" \"string Basis\" [\"" + std::string(basis) +
                            "\"] Curves \"cubic\" [7] \"nonperiodic\" \"P\" [" + p + "]"));
    EXPECT_EQ(r.object(0).shape().patchCount(), segments) << basis;
  }
  const Reading hermite(inWorld(
      "Attribute \"Ri\" \"string Basis\" [\"hermite\"] Curves \"cubic\" [8] \"nonperiodic\" \"P\" [" + p + "7 0 0]"));
  EXPECT_EQ(hermite.object(0).shape().patchCount(), 3u);
  const Reading power(inWorld(
      "Attribute \"Ri\" \"string Basis\" [\"power\"] Curves \"cubic\" [8] \"nonperiodic\" \"P\" [" + p + "7 0 0]"));
  EXPECT_EQ(power.object(0).shape().patchCount(), 2u);
}

vec3 sunOf(const std::string& params) {
  const Reading r(inWorld("Light \"PxrEnvDayLight\" \"sun\" " + params));
  const std::vector<float>& d = findParam(r.scene().lights.at(0)->shader.params, "sundirection")->floats;
  return {d[0], d[1], d[2]};
}

TEST(RisTable, TheSunStandsWhereDayHourAndPlaceSay) {
  // At noon of the sun's own time at the equinox it is as high as the equator: in the south, 90 - latitude up.
  const vec3 noon = sunOf(
      "\"int month\" 3 \"int day\" 21 \"float hour\" 12.1 \"float zone\" 0 \"float latitude\" 50 "
      "\"float longitude\" 0");
  expectNear(noon, {0, std::cos(glm::radians(50.0f)), -std::sin(glm::radians(50.0f))}, 0.02f);
  // Six hours later it sets in the west.
  const vec3 evening = sunOf(
      "\"int month\" 3 \"int day\" 21 \"float hour\" 18.1 \"float zone\" 0 \"float latitude\" 50 "
      "\"float longitude\" 0");
  expectNear(evening, {-1, 0, 0}, 0.02f);
  // 15 degrees to the east it is noon an hour earlier, as it is in a time zone that is an hour ahead.
  expectNear(sunOf("\"int month\" 3 \"int day\" 21 \"float hour\" 11.1 \"float zone\" 0 \"float latitude\" 50 \"float "
                   "longitude\" 15"),
             noon, 1e-3f);
  expectNear(sunOf("\"int month\" 3 \"int day\" 21 \"float hour\" 13.1 \"float zone\" 1 \"float latitude\" 50 \"float "
                   "longitude\" 0"),
             noon, 1e-3f);
  // In June it is 23.4 degrees higher, in December as much lower; of the defaults, Seattle's November is low in the
  // south-west.
  const auto height = [](int month, int day) {
    return glm::degrees(
        std::asin(sunOf("\"int month\" " + std::to_string(month) + " \"int day\" " + std::to_string(day) +
                        " \"float hour\" 12 \"float zone\" 0 \"float latitude\" 50 \"float longitude\" 0")
                      .y));
  };
  EXPECT_NEAR(height(6, 21), 40 + 23.4f, 0.3f);
  EXPECT_NEAR(height(12, 21), 40 - 23.4f, 0.3f);
  const float day_degrees = height(10, 1) - height(11, 1);
  EXPECT_NEAR(day_degrees, 11.2f, 0.7f);
  const vec3 seattle = sunOf("\"int month\" 11");
  EXPECT_NEAR(glm::degrees(std::asin(seattle.y)), 14.5f, 2.0f);
  EXPECT_TRUE(seattle.x < -0.3f && seattle.z < -0.5f) << seattle.x << ' ' << seattle.z;
  // The equation of time: the sun is early by 16 minutes in November, and late by 14 in February.
  const auto east = [](int month, int day) {
    return sunOf("\"int month\" " + std::to_string(month) + " \"int day\" " + std::to_string(day) +
                 " \"float hour\" 12 \"float zone\" 0 \"float latitude\" 0 \"float longitude\" 0")
        .x;
  };
  EXPECT_NEAR(east(11, 3), -std::sin(16.4f / 60 * kPi / 12) * std::cos(glm::radians(15.0f)), 0.01f);
  EXPECT_NEAR(east(2, 11), std::sin(14.2f / 60 * kPi / 12) * std::cos(glm::radians(14.0f)), 0.01f);
}

TEST(RisTable, TheSunStandsWhereItsDirectionSaysOrAhead) {
  expectNear(sunOf(""), {0, 0, 1});
  expectNear(sunOf("\"vector sunDirection\" [1 2 3]"), {1, 2, 3});
  expectNear(sunOf("\"vector direction\" [3 2 1]"), {3, 2, 1});
  const Reading r(
      inWorld("Light \"PxrEnvDayLight\" \"d\" \"vector direction\" [0 1 0] \"float haziness\" 3 \"float sunSize\" "
              "2 \"color sunTint\" [1 .5 0] \"color skyTint\" [0 .5 1] \"float intensity\" 4"));
  ASSERT_EQ(r.scene().lights.size(), 2u);
  const auto value = [&](size_t light, const char* name) {
    return findParam(r.scene().lights[light]->shader.params, name);
  };
  EXPECT_TRUE(r.scene().lights[0]->shader.name == "sunlight" && r.scene().lights[1]->shader.name == "daylight");
  EXPECT_TRUE(r.scene().lights[0]->handle == "d sun" && r.scene().lights[1]->handle == "d");
  EXPECT_EQ(value(0, "sunsize")->number(0), 2);
  EXPECT_EQ(value(1, "sunsize"), nullptr);
  EXPECT_EQ(value(0, "lightcolor")->floats, (std::vector<float>{1, .5f, 0}));
  EXPECT_EQ(value(1, "lightcolor")->floats, (std::vector<float>{0, .5f, 1}));
  for (const size_t light : {0u, 1u}) {
    EXPECT_EQ(value(light, "turbidity")->number(0), 3);
    EXPECT_EQ(value(light, "intensity")->number(0), 4);
  }
  EXPECT_EQ(r.codes(), "rib-substitute@2 ");
  EXPECT_EQ(Reading(inWorld("Light \"PxrEnvDayLight\" \"d\" \"vector direction\" [0 -1 0]")).codes(),
            "rib-substitute@2 rib-substitute@2 ")
      << "it is night";
}

}  // namespace
}  // namespace tomales
