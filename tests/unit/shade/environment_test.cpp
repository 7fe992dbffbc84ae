// Light from all around against closed forms: the irradiance of a sky of radiance L(w) over pi is the
// cosine-weighted mean of L.
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/unit/shade/stage.h"
#include "tests/unit/shade/written_picture.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

class Environment : public Stage {
 protected:
  ~Environment() override {
    if (!path.empty()) std::filesystem::remove(path);
  }

  /// A map of the radiance that `sky` gives for world directions.
  std::string writeMap(const std::function<vec3(const vec3&)>& sky) {
    const int w = 256, h = 128;
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path = test::temporary(std::string("tomales_sky_") + test->name() + ".exr");
    return writePicture(path, w, h, "RGB", [&](int x, int y) {
      const float theta = kPi * (static_cast<float>(y) + 0.5f) / h, phi = 2 * kPi * (static_cast<float>(x) + 0.5f) / w;
      const vec3 L = sky({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
      return std::array{L.x, L.y, L.z};
    });
  }
  /// Radiance of one point with normal N under many samples.
  vec3 litBy(const vec3& N, int samples = 1024) {
    ShadeContext fine;
    fine.lightSamples = samples;
    ShadePoints p = points({vec3(0, 0, 5)}, N);
    p.set3(kIx, 0, -N);
    return shade(p, fine).color(0);
  }
  std::string path;
};

const std::vector<vec3> kNormals{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {-0.6f, 0, 0.8f}, {0.48f, -0.6f, 0.64f}};

TEST_F(Environment, FewSamplesFindASmallSun) {
  const vec3 sun = glm::normalize(vec3(0.3f, -0.5f, 0.8f));
  const auto sky = [&](const vec3& d) { return vec3(dot(d, sun) > std::cos(0.05f) ? 1000.0f : 0.01f); };
  surface("matte", {number("Kd", 1)});
  light("environmentlight", {text("map", writeMap(sky))});
  double expected = 0;  // over pi, texel by texel
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x) {
      const double theta = M_PI * (y + 0.5) / 128, phi = 2 * M_PI * (x + 0.5) / 256, size = 2 * M_PI / 256 * M_PI / 128;
      const vec3 d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      expected += sky(d).x * std::max(0.0f, dot(d, sun)) * std::sin(theta) * size / M_PI;
    }
  EXPECT_NEAR(litBy(sun, 64).x / expected, 1, 0.15) << "by the cosine alone, one sample in 400 would meet it";
  EXPECT_NEAR(litBy(sun, 4096).x / expected, 1, 0.03);
}

TEST_F(Environment, UniformSkyGivesCsKdWithoutNoise) {
  attributes.color = {0.5f, 0.25f, 1};
  surface("matte", {number("Kd", 0.8f)});
  light("environmentlight", {number("intensity", 2), color("lightcolor", {1, 0.5f, 0.25f})});
  for (const vec3& N : kNormals)
    expectColor(litBy(N, 16), attributes.color * 0.8f * 2.0f * vec3(1, 0.5f, 0.25f), 1e-5f);
  EXPECT_TRUE(system().needsRays());
}

TEST_F(Environment, AsksForItsOwnNumberOfSamplesAndShadowsThemToInfinity) {
  surface("matte");
  light("environmentlight", {number("samples", 9)});
  shadeOne();
  EXPECT_EQ(services.shadowRays, 9);
  EXPECT_TRUE(services.lastSolar);
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  gather.lightSamples = 1;
  shadeOne(gather);
  EXPECT_EQ(services.shadowRays, 10);
}

TEST_F(Environment, AWallThatHidesHalfOfTheSkyTakesHalfOfTheLight) {
  surface("matte");
  light("environmentlight");
  services.visible = [](const vec3&, const vec3& toward) { return toward.x > 0 ? 1.0f : 0.0f; };
  EXPECT_NEAR(litBy({0, 0, -1}).x, 0.5f, 2e-3f);
  // The half-space above a plane tilted by a: (1 + cos a) / 2 of the irradiance.
  const float a = 0.7f;
  services.visible = [a](const vec3&, const vec3& toward) {
    return dot(toward, vec3(std::sin(a), 0, -std::cos(a))) > 0 ? 1.0f : 0.0f;
  };
  EXPECT_NEAR(litBy({0, 0, -1}).x, (1 + std::cos(a)) / 2, 3e-3f);
}

/// As far as 4 samples tell: behind an opening of 0.2 x 0.2, which fills a 90th of the sky, without portals most pixels
/// would be black.
TEST_F(Environment, APortalIsTheUnitSquareOfACoordinateSystem) {
  surface("matte");
  scene.worldFromNamed["window"] =
      glm::scale(glm::translate(mat4(1.0f), vec3(0, 0, 4)), vec3(0.2f));  // over (0, 0, 5), whose normal is -z
  light("environmentlight", {text("portals", "window")});
  services.visible = [](const vec3& from, const vec3& toward) {
    const vec3 there = toward.z < 0 ? from - toward * (from.z - 4) / toward.z : vec3(kInfinity);
    return std::max(std::abs(there.x), std::abs(there.y)) <= 0.1f ? 1.0f : 0.0f;
  };
  // Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-3: four quarters of 0.1 x 0.1 at a distance
  // of 1.
  const float x = 0.1f, root = std::sqrt(1 + x * x), factor = 4 * 2 * x / root * std::atan(x / root) / (2 * kPi);
  const float lit = litBy({0, 0, -1}, 4).x;
  EXPECT_NEAR(lit, factor, 0.25f * factor);
  EXPECT_NEAR(litBy({0, 0, -1}).x, factor, 0.01f * factor);
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Environment, OpeningsOfTheSceneArePortalsOfSkiesThatNameNone) {
  scene.worldFromNamed["window"] = mat4(1.0f);
  scene.cameraFromWorld = Motion::still(glm::translate(mat4(1.0f), vec3(0, 0, 7)));
  scene.worldFromOpenings = {glm::scale(mat4(1.0f), vec3(2))};
  light("environmentlight");
  light("environmentlight", {text("portals", "window")});
  light("distantlight").castsShadows = true;
  ASSERT_EQ(system().light(0).portals().size(), 1u);
  EXPECT_EQ(system().light(0).portals()[0].corner, vec3(-1, -1, 7));
  ASSERT_EQ(system().light(1).portals().size(), 1u);
  EXPECT_EQ(system().light(1).portals()[0].corner, vec3(-0.5f, -0.5f, 7));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(system().light(k).takesFoundPortals(), k == 0) << k;
  scene.worldFromOpenings.push_back(mat4(1.0f));
  system().takeFoundPortals();
  EXPECT_EQ(system().light(0).portals().size(), 2u);
  EXPECT_EQ(system().light(1).portals().size(), 1u);
}

TEST_F(Environment, APortalThatIsNotNamedAnywhereIsTold) {
  surface("matte");
  scene.worldFromNamed["flat"] = glm::scale(mat4(1.0f), vec3(1, 0, 1));
  light("environmentlight", {text("portals", "door flat")});
  expectColor(litBy({0, 0, -1}), vec3(1), 1e-4f);
  EXPECT_EQ(log.count("light-portal"), 2);
}

TEST_F(Environment, LinearSkyHasTheIrradianceOfItsClosedForm) {
  surface("matte");
  // E/pi of L = a + b.w is a + 2/3 b.N: the mean of w over the cosine-weighted hemisphere is 2/3 N.
  const vec3 b(0.2f, 0.3f, 0.4f);
  light("environmentlight", {text("map", writeMap([b](const vec3& w) { return vec3(1, 2, 0.5f) + vec3(dot(b, w)); }))});
  for (const vec3& N : kNormals) expectColor(litBy(N), vec3(1, 2, 0.5f) + vec3(2.0f / 3 * dot(b, N)), 3e-3f);
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Environment, TheMapStandsInTheWorldNotInTheCamera) {
  surface("matte");
  // The camera looks down the world's z axis: its +z is the world's -z, its y the world's -y.
  scene.cameraFromWorld = Motion::still(mat4(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1));
  light("environmentlight", {text("map", writeMap([](const vec3& w) { return vec3(1 + w.z, 1 + w.y, 1 + w.x); }))});
  expectColor(litBy({0, 0, -1}), {5.0f / 3, 1, 1}, 3e-3f);
  expectColor(litBy({0, -1, 0}), {1, 5.0f / 3, 1}, 3e-3f);
  expectColor(litBy({1, 0, 0}), {1, 1, 5.0f / 3}, 3e-3f);
}

TEST_F(Environment, TheMapMayStandInTheSpaceOfTheLight) {
  surface("matte");
  scene.cameraFromWorld = Motion::still(mat4(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1));
  LightCall& sky =
      light("environmentlight", {text("map", writeMap([](const vec3& w) { return vec3(1 + w.z, 1 + w.y, 1 + w.x); })),
                                 text("mapspace", "shader")});
  // Twice as large as the world; its z is the world's x, its x the world's y.
  sky.shader.worldFromShader = Motion::still(mat4(0, 2, 0, 0, 0, 0, 2, 0, 2, 0, 0, 0, 0, 0, 0, 1));
  expectColor(litBy({1, 0, 0}), {5.0f / 3, 1, 1}, 3e-3f);  // current x is the world's, the map's z
  expectColor(litBy({0, -1, 0}), {1, 1, 5.0f / 3}, 3e-3f);
  expectColor(litBy({0, 0, -1}), {1, 5.0f / 3, 1}, 3e-3f);
}

TEST_F(Environment, AMapSpaceThatThereIsNotIsTheWorldAndTold) {
  surface("matte");
  scene.cameraFromWorld = Motion::still(mat4(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1));
  light("environmentlight", {text("map", writeMap([](const vec3& w) { return vec3(1 + w.z, 1 + w.y, 1 + w.x); })),
                             text("mapspace", "object")});
  expectColor(litBy({0, 0, -1}), {5.0f / 3, 1, 1}, 3e-3f);
  ASSERT_EQ(log.count("light-mapspace"), 1);
  EXPECT_EQ(log.worst(), Severity::Warning);
}

TEST_F(Environment, ShinyMetalMirrorsTheMapByTheReflectedDirection) {
  surface("shinymetal", {number("Kr", 0.5f), text("texturename", writeMap([](const vec3& w) { return vec3(1) + w; }))});
  attributes.color = {1, 0.5f, 1};
  ShadePoints p = points({vec3(0, 0, 5)}, glm::normalize(vec3(1, 0, -1)));
  expectColor(shade(p).color(0), 0.5f * attributes.color * vec3(2, 1, 1), 2e-3f);  // I = +z, R = +x
}

TEST_F(Environment, AMirrorSeesTheSkyWhereItsRaysLeaveTheScene) {
  surface("mirror", {number("Kr", 0.5f)});
  light("environmentlight", {number("intensity", 2), text("map", writeMap([](const vec3& w) { return vec3(1) + w; }))});
  services.seen = [](const vec3& d) { return d.x > 0 ? vec3(0) : vec3(0.25f, 0, 0); };
  services.met = [](const vec3&, const vec3& d) { return d.x > 0 ? kInfinity : 3.0f; };
  ShadePoints p = points({vec3(0, 0, 5), vec3(0, 0, 5)}, glm::normalize(vec3(1, 0, -1)));
  p.set3(kNx, 1, glm::normalize(vec3(-1, 0, -1)));
  p.set3(kNgx, 1, glm::normalize(vec3(-1, 0, -1)));
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {2, 1, 1}, 4e-3f);  // R = +x
  expectColor(out.color(1), {0.125f, 0, 0});    // R = -x, where something is
}

TEST_F(Environment, SkiesThatAreNotVisibleOrNotSpecularAreNotMirroredNorByWideRays) {
  surface("mirror", {number("blur", 0)});
  light("environmentlight", {number("visible", 0)});
  light("environmentlight", {number("__nonspecular", 1)});
  services.met = [](const vec3&, const vec3&) { return kInfinity; };
  expectColor(shadeOne(), {0, 0, 0});
}

TEST_F(Environment, WideRaysLeaveTheSkyToDiffuse) {
  surface("mirror", {number("blur", 1), number("samples", 4)});
  light("environmentlight");
  services.met = [](const vec3&, const vec3&) { return kInfinity; };
  expectColor(shadeOne(), {0, 0, 0});
}

// A white metal in a white sky is as bright as the sky, by the lights alone as with rays that mirror the scene: light
// samples bring the sky once.
TEST_F(Environment, RaysThatPassLampsPassTheSky) {
  const auto lit = [&](float rays) {
    shading.reset();
    scene = {};
    attributes = {};
    surface("disney", {number("metallic", 1), number("roughness", 0.2f), number("reflections", rays)});
    light("environmentlight", {number("samples", 256)});
    return litBy({0, 0, -1}, 256).x;
  };
  services.met = [](const vec3&, const vec3&) { return kInfinity; };
  const float alone = lit(0);
  EXPECT_NEAR(alone, 1, 0.02f);
  EXPECT_NEAR(lit(8), alone, 0.01f);
}

TEST_F(Environment, AMissingMapIsMagentaAndReportedOnce) {
  surface("matte");
  light("environmentlight", {text("map", "absent.exr")});
  expectColor(litBy({0, 0, -1}, 16), {1, 0, 1});
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.worst(), Severity::Missing);
}

}  // namespace
}  // namespace tomales
