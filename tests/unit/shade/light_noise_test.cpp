// When it is said that the samples of a lamp are too few.
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

/// A small lamp of two samples, one in each half of it.
class LightNoises : public Stage {
 protected:
  LightNoises() {
    surface("matte");
    light("arealight", {number("samples", 2)}, true);
    services.emitter = [](float a, float b, vec3& P, vec3& N, float& area) {
      P = {-0.01f + 0.02f * a, -0.01f + 0.02f * b, 3};
      N = {0, 0, 1};
      area = 4e-4f;
    };
  }
  /// Shades points of which `shadowed` get that share of the light of one half of the lamp, and the others get all.
  bool isSaid(int shadowed, int open, float share = 0, const ShadeContext& context = {}) {
    services.visible = [share](const vec3& P, const vec3& toward) {
      return P.x < 0 && (P + toward).x < 0 ? share : 1.0f;
    };
    shading.reset();
    scene.objects.clear();
    std::vector<vec3> places(static_cast<size_t>(shadowed), vec3(-1, 0, 5));
    places.resize(static_cast<size_t>(shadowed + open), vec3(1, 0, 5));
    shade(points(places), context);
    const int before = log.count("light-noise");
    system().warnOfLightNoise();
    return log.count("light-noise") > before;
  }
};

TEST_F(LightNoises, AreSaidWhereMostPointsAreUncertain) {
  EXPECT_TRUE(isSaid(200, 0));
  EXPECT_TRUE(isSaid(102, 98));
  EXPECT_FALSE(isSaid(98, 102));
  EXPECT_FALSE(isSaid(0, 200));
}

TEST_F(LightNoises, OfFewPointsSayNothing) {
  EXPECT_FALSE(isSaid(99, 0));
  EXPECT_TRUE(isSaid(100, 0));
}

TEST_F(LightNoises, BeginAtAFifthOfTheLight) {
  EXPECT_FALSE(isSaid(200, 0, 0.69f)) << "the halves differ by 0.31 / 1.69";
  EXPECT_TRUE(isSaid(200, 0, 0.64f));
}

TEST_F(LightNoises, OfPointsThatShareAPixelAreLess) {
  attributes.shadingRate = 0.06f;
  EXPECT_TRUE(isSaid(200, 0)) << "by 0.82 of the light";
  attributes.shadingRate = 0.039f;
  EXPECT_FALSE(isSaid(200, 0)) << "by more than all of it";
  attributes.shadingRate = 100;
  EXPECT_FALSE(isSaid(200, 0, 0.69f));
}

TEST_F(LightNoises, CountInThePictureAlone) {
  EXPECT_FALSE(isSaid(200, 0, 0, {.kind = RayKind::Diffuse}));
  EXPECT_FALSE(isSaid(200, 0, 0, {.purpose = Purpose::Sketch}));
  EXPECT_FALSE(isSaid(200, 0, 0, {.illumination = Illumination::Stored}));
}

TEST_F(LightNoises, AreNotThoseOfALampOfOneSampleWhichHasNoHalves) {
  light("arealight", {number("samples", 1), number("intensity", 100)}, true).handle = "single";
  EXPECT_FALSE(isSaid(0, 200));
}

TEST_F(LightNoises, NameTheLampThatBringsMost) {
  light("distantlight", {number("intensity", 1e-6f)});
  light("arealight", {number("samples", 2), number("intensity", 1e-6f)}, true).handle = "dim";
  ASSERT_TRUE(isSaid(200, 0));
  EXPECT_NE(log.entries().back().message.find("arealight"), std::string::npos) << log.entries().back().message;
}

}  // namespace
}  // namespace tomales
