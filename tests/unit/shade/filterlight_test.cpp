// The filter light against equation 9 and against colours worked out by hand.
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

class FilterLight : public Stage {
 protected:
  FilterLight() {
    services.E = {0.5f, 0.25f, 0.125f};
    services.dominant[0] = glm::normalize(vec3(1, 0, -1));
    services.dominant[1] = {1, 0, 0.1f};
    surface("matte");
  }
  /// The source is switched off, as by Illuminate.
  void filter(ParamList params, ParamList source = {}) {
    light("indirectlight", std::move(source)).handle = "gi";
    attributes.lights.clear();
    params.push_back(text("source", "gi"));
    light("filterlight", std::move(params));
  }
  vec3 at(const vec3& P, const vec3& N = vec3(0, 0, -1)) { return shade(points({P}, N)).color(0); }
};

TEST_F(FilterLight, ByDefaultIsItsSource) {
  filter({}, {number("intensity", 2), color("lightcolor", {1, 2, 3}), number("samples", 77)});
  expectColor(shadeOne(), services.E * 2.0f * vec3(1, 2, 3), 1e-5f);
  EXPECT_EQ(services.queries.back().samples, 77);
  ASSERT_NE(system().group(0).indirectQuery(), nullptr);
  EXPECT_EQ(system().group(0).indirectQuery()->samples, 77) << "the gather pass prepares what the filter asks for";
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(FilterLight, AddsToASourceThatStaysOn) {
  light("indirectlight").handle = "gi";
  light("filterlight", {text("source", "gi"), number("brightness", 0.5f)});
  expectColor(shadeOne(), 1.5f * services.E, 1e-5f);
}

TEST_F(FilterLight, DirectionalityIsEquationNine) {
  filter({number("directionality", 3), point("from", {0, 0, 0})});
  for (const float theta : {0.0f, 0.5f, 1.2f, 2.4f}) {
    const vec3 N(std::sin(theta), 0, -std::cos(theta));
    ShadePoints p = points({vec3(0, 0, 5)}, N);
    p.set3(kIx, 0, -N);  // seen from its front
    expectColor(shade(p).color(0), services.E * std::pow(std::cos(theta / 2), 3.0f), 1e-5f);
  }
}

TEST_F(FilterLight, ConeAndDistanceHaveSoftEdges) {
  filter(
      {number("coneangle", 0.5f), number("conedeltaangle", 0.2f), number("distance", 10), number("distancedelta", 4)});
  const auto along = [](float angle, float d) { return vec3(std::sin(angle), 0, std::cos(angle)) * d; };
  EXPECT_NEAR(at(along(0.29f, 5)).x, 0.5f, 1e-5f);
  EXPECT_NEAR(at(along(0.4f, 5)).x, 0.25f, 1e-4f);
  EXPECT_NEAR(at(along(0.1f, 8)).x, 0.25f, 1e-4f);
  EXPECT_EQ(at(along(0.51f, 5)).x, 0);
  EXPECT_EQ(at(along(0.1f, 10.1f)).x, 0);
}

TEST_F(FilterLight, CorrectsColoursOfAllChannelsTogether) {
  const vec3 E = services.E;
  filter({number("saturation", 0), number("brightness", 2)});
  expectColor(shadeOne(), vec3(2 * (0.2126f * E.x + 0.7152f * E.y + 0.0722f * E.z)), 1e-5f);
}

TEST_F(FilterLight, HueTurnsChannelsAndContrastKeepsMiddleGrey) {
  filter({number("hue", 1.0f / 3), number("contrast", 2)});
  const vec3 E = services.E, bent = E * E / 0.18f;
  expectColor(shadeOne(), {bent.z, bent.x, bent.y}, 1e-5f);
  services.E = vec3(0.18f);
  expectColor(shadeOne(), vec3(0.18f), 1e-5f);
}

TEST_F(FilterLight, NeverGoesNegative) {
  filter({number("saturation", 10)});
  expectColor(glm::min(shadeOne(), vec3(0.0f)), vec3(0.0f), 0);
}

TEST_F(FilterLight, WithoutASourceCastsNoLightAndSaysSo) {
  light("distantlight").handle = "gi";
  light("filterlight", {text("source", "gi")});
  expectColor(shadeOne(), vec3(1));
  EXPECT_EQ(log.count("light-source"), 1);
  EXPECT_EQ(log.worst(), Severity::Missing);
}

}  // namespace
}  // namespace tomales
