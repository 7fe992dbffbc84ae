// Sun and sky (Preetham, Shirley and Smits 1999) against measured daylight and the model's own numbers.
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

constexpr float kUnit_klx = 30 * kPi;  // of irradiance over pi

class Daylight : public Stage {
 protected:
  static Param vector(const std::string& name, const vec3& v) { return triple(name, ValueType::Vector, v); }
  /// What white paper with normal N reflects, the sun `zenithAngle_degrees` from straight up (y) towards x.
  vec3 onPaper(const std::string& shader, float zenithAngle_degrees, const vec3& N = {0, 1, 0}, float turbidity = 2,
               int samples = 1024) {
    scene = Scene();
    attributes = Attributes();
    shading.reset();
    surface("matte");
    const float a = glm::radians(zenithAngle_degrees);
    light(shader, {vector("sundirection", {std::sin(a), std::cos(a), 0}), number("turbidity", turbidity)});
    ShadeContext fine;
    fine.lightSamples = samples;
    ShadePoints p = points({vec3(0, 0, 5)}, N);
    p.set3(kIx, 0, -N);
    return shade(p, fine).color(0);
  }
};

TEST_F(Daylight, OfAHighSunIsAHundredThousandLux) {
  const float klx = kUnit_klx * luminance(onPaper("sunlight", 20));
  EXPECT_GT(klx, 85 * std::cos(glm::radians(20.0f)));
  EXPECT_LT(klx, 115 * std::cos(glm::radians(20.0f)));
}

TEST_F(Daylight, OfAClearSkyIsAFifthOfTheSunsAndBlue) {
  const vec3 sky = onPaper("daylight", 40);
  EXPECT_GT(kUnit_klx * luminance(sky), 10);
  EXPECT_LT(kUnit_klx * luminance(sky), 26);
  EXPECT_GT(sky.z, 1.3f * sky.x);
}

TEST_F(Daylight, OfALowSunIsRedAndWeak) {
  const vec3 high = onPaper("sunlight", 20, {1, 0, 0}), low = onPaper("sunlight", 87, {1, 0, 0});
  EXPECT_GT(low.x / low.z, 2 * high.x / high.z);
  EXPECT_LT(luminance(low) / std::sin(glm::radians(87.0f)), 0.3f * luminance(high) / std::sin(glm::radians(20.0f)));
}

TEST_F(Daylight, IsBrighterTowardsTheSunAndAlikeToBothSides) {
  EXPECT_GT(luminance(onPaper("daylight", 60, {1, 0, 0})), 1.5f * luminance(onPaper("daylight", 60, {-1, 0, 0})));
  const vec3 left = onPaper("daylight", 60, {0, 0, 1}), right = onPaper("daylight", 60, {0, 0, -1});
  EXPECT_NEAR(luminance(left), luminance(right), 0.01f * luminance(left));
}

TEST_F(Daylight, ComesFromAboveTheHorizonAlone) {
  EXPECT_EQ(onPaper("daylight", 40, {0, -1, 0}), vec3(0));
  for (const char* shader : {"daylight", "sunlight"}) EXPECT_EQ(onPaper(shader, 91), vec3(0)) << shader;
}

TEST_F(Daylight, OfTheSunIsTheSameForAnySizeOfIt) {
  const vec3 real = onPaper("sunlight", 30);
  light("sunlight");
  EXPECT_NEAR(luminance(onPaper("sunlight", 30, {0, 1, 0}, 2, 16)), luminance(real), 0.002f * luminance(real));
}

TEST_F(Daylight, IsPaleWhereItIsHazy) {
  const vec3 clear = onPaper("daylight", 40), hazy = onPaper("daylight", 40, {0, 1, 0}, 8);
  EXPECT_GT(clear.z / clear.x, 1.1f * hazy.z / hazy.x);
  EXPECT_LT(luminance(onPaper("sunlight", 40, {0, 1, 0}, 8)), luminance(onPaper("sunlight", 40)));
}

}  // namespace
}  // namespace tomales
