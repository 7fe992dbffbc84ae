#include <utility>

#include "reyes/area_lights.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

using Lights = Stage;

TEST_F(Lights, MatteUnderADistantLightIsCsKdCosine) {
  attributes.color = {0.5f, 0.25f, 1};
  surface("matte", {number("Kd", 0.8f)});
  const float angle = 1.0f;
  light("distantlight",
        {point("from", {0, 0, 0}), point("to", {std::sin(angle), 0, std::cos(angle)}), number("intensity", 2)});
  expectColor(shadeOne(), attributes.color * 0.8f * 2.0f * std::cos(angle));
  expectColor(shade(points({vec3(0, 0, 5)})).opacity(0), vec3(1));
}

TEST_F(Lights, AmbientLightReachesAmbientAloneAndOpacityPremultiplies) {
  attributes.opacity = {0.5f, 0.25f, 1};
  surface("matte", {number("Ka", 0.5f)});
  light("ambientlight", {color("lightcolor", {1, 2, 3})});
  expectColor(shadeOne(), attributes.opacity * 0.5f * vec3(1, 2, 3));
}

TEST_F(Lights, PointLightFallsOffWithTheSquareOfDistance) {
  surface("matte");
  light("pointlight", {number("intensity", 12)});
  const ShadedPoints out = shade(points({vec3(0, 0, 1), vec3(0, 0, 2), vec3(0, 0, 4)}));
  expectColor(out.color(0), vec3(12.0f));
  expectColor(out.color(1), vec3(3.0f));
  expectColor(out.color(2), vec3(0.75f));
}

TEST_F(Lights, PointsAmongTheParametersOfALightAreInShaderSpace) {
  surface("matte");
  scene.cameraFromWorld = Motion::still(mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 3, 1));
  light("pointlight", {number("intensity", 1)});
  expectColor(shade(points({vec3(0, 0, 5)})).color(0), vec3(0.25f));  // the world origin lies at z = 3
}

TEST_F(Lights, SpotlightIsFullInsideItsConeAndDarkOutside) {
  surface("matte");
  light("spotlight", {number("coneangle", 0.5f), number("conedeltaangle", 0.1f), number("beamdistribution", 3)});
  const auto under = [](float angle) { return vec3(10 * std::tan(angle), 0, 10); };
  const ShadedPoints out = shade(points({under(0), under(0.39f), under(0.45f), under(0.501f)}));
  const auto full = [](float angle) { return std::pow(std::cos(angle), 3.0f + 1 + 2) / 100; };
  EXPECT_NEAR(out.color(0).x, full(0), 1e-6f);
  EXPECT_NEAR(out.color(1).x, full(0.39f), 1e-6f);
  const float t = (std::cos(0.45f) - std::cos(0.5f)) / (std::cos(0.4f) - std::cos(0.5f));
  EXPECT_NEAR(out.color(2).x, full(0.45f) * t * t * (3 - 2 * t), 1e-6f);
  EXPECT_EQ(out.color(3).x, 0);
}

TEST_F(Lights, HighlightsHaveThePrmanExponent) {
  surface("metal", {number("roughness", 0.2f)});
  const float angle = 0.6f;
  light("distantlight", {point("to", {std::sin(angle), 0, std::cos(angle)})});
  EXPECT_NEAR(shadeOne().x, std::pow(std::cos(angle / 2), 8 / 0.2f), 1e-5f);
}

TEST_F(Lights, DiffuseRaysSeeTheHighlightsThatTheyAskFor) {
  surface("plastic", {number("Kd", 0.5f), number("Ks", 1)});
  light("distantlight");
  expectColor(shadeOne(), vec3(1.5f));
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  expectColor(shadeOne(gather), vec3(0.5f));
  gather.highlights = HitHighlights::OfSpecular;
  expectColor(shadeOne(gather), vec3(1.5f));
}

TEST_F(Lights, LightingChoosesBetweenDirectAndIndirect) {
  surface("matte");
  light("distantlight", {text("lighting", "indirect"), number("intensity", 2)});
  light("distantlight", {text("lighting", "direct"), number("intensity", 3)});
  light("distantlight", {text("lighting", "both"), number("intensity", 5)});
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  expectColor(shadeOne(), vec3(8));
  expectColor(shadeOne(gather), vec3(7));
  EXPECT_EQ(log.entries().size(), 0u);
}

// The irradiance of a polygon of unit radiance over pi (Lambert 1760): sum of edge angles times edge normals.
double lambert(const std::vector<glm::dvec3>& polygon, const glm::dvec3& P, const glm::dvec3& N) {
  double sum = 0;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec3 a = glm::normalize(polygon[k] - P), b = glm::normalize(polygon[(k + 1) % polygon.size()] - P);
    sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), N);
  }
  return std::abs(sum) / (2 * 3.14159265358979323846);
}

class AreaLight : public Stage {
 protected:
  // A rectangle in z = 3 that faces +z, as the floor at z = 5 faces -z.
  void rectangle(const vec3& normal) {
    services.emitter = [normal](float a, float b, vec3& P, vec3& N, float& area) {
      P = {-1 + 2 * a, -0.5f + b, 3};
      N = normal;
      area = 2;
    };
  }
};

TEST_F(AreaLight, IrradianceOfARectangleIsTheClosedFormAtNinePoints) {
  surface("matte");
  light("arealight", {number("intensity", 4)}, true);
  rectangle({0, 0, 1});
  std::vector<vec3> P;
  for (int i = 0; i < 9; ++i) P.push_back({static_cast<float>(i % 3), static_cast<float>(i / 3) - 1, 5});
  ShadeContext fine;
  fine.lightSamples = 1024;
  const ShadedPoints out = shade(points(P), fine);
  for (int i = 0; i < 9; ++i) {
    const double E =
        4 * lambert({{-1, -.5, 3}, {1, -.5, 3}, {1, .5, 3}, {-1, .5, 3}}, P[static_cast<size_t>(i)], {0, 0, -1});
    EXPECT_NEAR(out.color(i).x, E, 0.01 * E) << "point " << i;
  }
}

TEST_F(AreaLight, StopsTracingShadowsWhereTheirMeanIsKnownWellEnough) {
  surface("matte");
  light("arealight", {number("samples", 64), number("shadowvariance", 0.002f)}, true);
  rectangle({0, 0, 1});
  const auto visible = [](const vec3& P, const vec3& toward) { return (P + toward).x > 0.3f ? 0.0f : 1.0f; };
  const ShadePoints clear = points({vec3(0, 0, 5)});
  const float open = shade(clear).color(0).x;
  const int inTheOpen = std::exchange(services.shadowRays, 0);
  services.visible = visible;
  const float penumbra = shade(clear).color(0).x;
  EXPECT_LT(inTheOpen, 24);  // 0.5 / (n + 1) (1 - 0.5 / (n + 1)) / n < 0.002 at n = 16
  EXPECT_GT(services.shadowRays, 2 * inTheOpen);
  ShadeContext fine;
  fine.lightSamples = 4096;
  EXPECT_NEAR(penumbra / open, shade(clear, fine).color(0).x / open, 3 * std::sqrt(0.002f));
}

TEST_F(AreaLight, EmitsFromTheSideOfItsNormalOnly) {
  surface("matte");
  light("arealight", {}, true);
  rectangle({0, 0, -1});
  expectColor(shadeOne(), vec3(0.0f), 0);
}

TEST_F(AreaLight, ShadowRaysGoToTheSampleAndOnlyFromPointsOnItsSide) {
  surface("plastic");
  light("arealight", {number("samples", 8)}, true);
  rectangle({0, 0, 1});
  services.visible = [](const vec3& P, const vec3& toward) {
    EXPECT_NEAR((P + toward).z, 3, 1e-5f);
    return 0.0f;
  };
  expectColor(shadeOne(), vec3(0.0f), 0);
  EXPECT_EQ(services.shadowRays, 8);  // diffuse() and specular() share them
  shade(points({vec3(0, 0, 5)}, vec3(0, 1, 0)));
  EXPECT_LT(services.shadowRays, 16);  // this point sees half of the rectangle
}

TEST_F(AreaLight, GlowsForTheCameraUnlessInvisible) {
  light("arealight", {number("intensity", 3), color("lightcolor", {1, 2, 4})}, true);
  light("arealight", {number("visible", 0)}, true);
  attributes.areaLight = 0;
  EXPECT_EQ(emissionOf(system(), points({vec3(0, 0, 5)})), std::vector<vec3>{vec3(3, 6, 12)});
  EXPECT_TRUE(system().needsRays());
  shading.reset();
  scene.objects.clear();
  attributes.areaLight = 1;
  EXPECT_TRUE(emissionOf(system(), points({vec3(0, 0, 5)})).empty());
}

TEST_F(AreaLight, SamplesDoNotDependOnTheCompanyOfAPoint) {
  surface("matte");
  light("arealight", {}, true);
  rectangle({0, 0, 1});
  std::vector<vec3> many(600, vec3(0.3f, 0.4f, 5));
  const ShadedPoints together = shade(points(many));
  ShadePoints alone(0, 0);
  const ShadePoints all = points(many);
  alone.add(all.key(517));
  for (int c = 0; c < all.channelCount(); ++c) alone.channel(c)[0] = all.channel(c)[517];
  EXPECT_EQ(shade(alone).color(0), together.color(517));
  EXPECT_NE(together.color(517), together.color(516));
  ShadeContext reseeded;
  reseeded.seed = 1;
  EXPECT_NE(shade(alone, reseeded).color(0), together.color(517));
}

TEST_F(Lights, ShadowsOfAPointLightNeedTheAttribute) {
  surface("matte");
  services.visible = [](const vec3&, const vec3&) { return 0.25f; };
  light("distantlight");
  light("distantlight").castsShadows = true;
  expectColor(shadeOne(), vec3(1.25f));
  EXPECT_TRUE(services.lastSolar);
  EXPECT_EQ(services.shadowRays, 1);
}

TEST_F(Lights, WithoutServicesLightIsUnshadowedAndAreaLightsAreDark) {
  surface("matte");
  light("distantlight").castsShadows = true;
  light("arealight", {}, true);
  light("indirectlight");
  system().setServices(nullptr);
  expectColor(shadeOne(), vec3(1));
}

TEST_F(Lights, ShadowsOfMapsThatCannotBeReadAreTraced) {
  surface("matte");
  services.visible = [](const vec3&, const vec3&) { return 0.25f; };
  const auto to = point("to", {0, 0, 9});
  light("shadowdistant", {to, text("shadowname", "sun.shd")});
  light("shadowpoint", {number("intensity", 25), text("sfpx", "a.shd")});
  light("shadowspot", {number("intensity", 25), to, text("shadowname", "raytrace")});
  light("shadowspot", {number("intensity", 25), to});
  expectColor(shadeOne(), vec3(3 * 0.25f + 1));
  EXPECT_EQ(services.shadowRays, 3);
  EXPECT_EQ(log.count("shadow-map"), 2);
  EXPECT_TRUE(system().needsRays());
}

TEST_F(Lights, IndirectLightGivesItsIrradianceBackToDiffuse) {
  attributes.color = {0.5f, 0.25f, 1};
  services.E = {1, 2, 3};
  for (int k = 0; k < 3; ++k) services.dominant[k] = glm::normalize(vec3(static_cast<float>(k), 1, -1));
  surface("matte", {number("Kd", 0.5f)});
  light("indirectlight");
  expectColor(shadeOne(), attributes.color * 0.5f * services.E, 2e-6f);
  EXPECT_EQ(services.gathers, 1);  // one gather serves three colours
  shading.reset();
  scene.objects.clear();
  surface("plastic", {number("Kd", 0.5f), number("Ks", 0)});
  expectColor(shadeOne(), attributes.color * 0.5f * services.E, 2e-6f);
}

TEST_F(Lights, IndirectLightFromBelowTheHorizonStillGivesItsIrradianceBack) {
  services.E = {1, 2, 3};
  services.dominant[0] = {1, 0, 0};
  services.dominant[1] = glm::normalize(vec3(1, 0, 1));
  services.dominant[2] = {0, 0, 1};
  surface("matte");
  light("indirectlight");
  expectColor(shadeOne(), services.E, 1e-5f);
}

TEST_F(Lights, NondiffuseAndNonspecularLightsAreLeftOut) {
  surface("plastic", {number("Kd", 1), number("Ks", 1)});
  light("distantlight", {number("intensity", 3), number("__nondiffuse", 1)});
  light("distantlight", {number("intensity", 5), number("__nonspecular", 1)});
  expectColor(shadeOne(), vec3(8));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Lights, MistakenLightsAreWarnedAbout) {
  light("arealight");
  light("pointlight", {}, true);
  light("distantlight", {text("lighting", "sideways"), text("shadowname", "map.shd")});
  system();
  EXPECT_EQ(log.count("light-area"), 2);
  const std::vector<LogEntry> said = log.entries();
  EXPECT_EQ(std::count_if(said.begin(), said.end(), [](const LogEntry& e) { return e.severity == Severity::Missing; }),
            1)
      << "the area light without geometry lights nothing";
  EXPECT_EQ(log.count("light-lighting"), 1);
  EXPECT_EQ(log.count("light-shadow-map"), 1);
}

TEST_F(Lights, IndirectLightObeysReceiveGainContextAndItsOwnTint) {
  services.E = {1, 1, 1};
  surface("matte");
  attributes.indirect.gain = 2;
  light("indirectlight",
        {number("intensity", 3), color("lightcolor", {1, 2, 4}), number("samples", 77), number("maxerror", 0.5f)});
  expectColor(shadeOne(), 6.0f * vec3(1, 2, 4));
  EXPECT_EQ(services.queries.back().samples, 77);
  ASSERT_NE(system().group(0).indirectQuery(), nullptr);
  EXPECT_EQ(system().group(0).indirectQuery()->maxError, 0.5f);
  ShadeContext direct;
  direct.indirect = false;
  expectColor(shadeOne(direct), vec3(0.0f));
  shading.reset();
  scene.objects.clear();
  attributes.indirect.receive = false;
  expectColor(shadeOne(), vec3(0.0f));
  EXPECT_EQ(system().group(0).indirectQuery(), nullptr);
}

/// A rectangle of 2 x 3 in its plane.
class Rectangle final : public Prim {
 public:
  Rectangle() : Prim({}) {}
  uint32_t patchCount() const override { return 2; }
  PatchInfo info(uint32_t) const override { return {}; }
  Bound3 bound(uint32_t, const UvRect&) const override { return {vec3(0), vec3(2, 3, 0)}; }
  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    for (int i = 0; i < n; ++i) {
      out.px[i] = u[i] + static_cast<float>(patch);
      out.py[i] = 3 * v[i];
      out.pz[i] = 0;
    }
  }
  void interpolate(uint32_t, int, int, const float*, const float*, float*, int) const override {}
  Kept kept(uint32_t, const UvRect&) const override { return isTrimmed ? Kept::Part : Kept::All; }
  bool keeps(uint32_t patch, float u, float v) const override { return !isTrimmed || (patch == 0 && u < v); }

  bool isTrimmed = false;
};

TEST_F(Lights, BmrtMeasuresTheGeometryOfAreaLights) {
  for (const bool bmrt : {true, false}) {
    scene.objects.clear();
    scene.lights.clear();
    if (bmrt)
      scene.options.user["shade:arealight"] = text("arealight", "bmrt");
    else
      scene.options.user.clear();
    light("arealight", {}, true);
    auto lamp = std::make_shared<Attributes>();
    lamp->areaLight = 0;
    Object o;
    o.shapes = {std::make_shared<Rectangle>()};
    mat4 twice(2.0f);
    twice[3][3] = 1;
    o.worldFromObject = Motion::still(twice);
    o.attributes = lamp;
    scene.objects.push_back(o);
    scene.freeze();
    measureAreaLights(scene, registry, log);
    const ParamList& params = scene.lights[0]->shader.params;
    ASSERT_EQ(params.size(), bmrt ? 1u : 0u);
    if (!bmrt) continue;
    EXPECT_NEAR(params[0].number(0), 2 * 3 * 4, 1e-3f);
    auto trimmed = std::make_shared<Rectangle>();
    trimmed->isTrimmed = true;
    scene.objects[0].shapes = {trimmed};
    scene.lights[0]->shader.params.clear();
    measureAreaLights(scene, registry, log);
    EXPECT_NEAR(scene.lights[0]->shader.params.at(0).number(0), 0.25f * 2 * 3 * 4, 0.1f) << "of what trim curves leave";
  }
}

// Each point draws some of many lamps; in the mean that is the light of all.
TEST_F(Lights, FewOfManyLightsBringTheLightOfAllInTheMean) {
  vec3 sums[2];
  for (const bool all : {true, false}) {
    shading.reset();
    scene.objects.clear();
    scene.lights.clear();
    attributes.lights.clear();
    scene.options.user["trace:lightcut"] = number("lightcut", all ? 0.0f : 2.0f);
    surface("matte", {number("Kd", 1)});
    for (int k = 0; k < 200; ++k) {
      const auto x = static_cast<float>(k % 20), y = static_cast<float>(k / 20);
      light("pointlight",
            {number("intensity", 0.1f + 0.01f * static_cast<float>(k % 7)),
             color("lightcolor", {1, 0.1f * static_cast<float>(k % 5), 0.5f}), point("from", {x - 9.5f, y - 4.5f, 2})});
    }
    const ShadedPoints out = shade(points(std::vector<vec3>(2000, vec3(1, 0.5f, 5))));
    vec3 sum(0);
    for (int i = 0; i < 2000; ++i) sum += out.color(i) / 2000.0f;
    sums[all] = sum;
  }
  EXPECT_NE(sums[0], sums[1]) << "lamps are drawn";
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sums[0][c] / sums[1][c], 1, 0.02) << c;
}

}  // namespace
}  // namespace tomales
