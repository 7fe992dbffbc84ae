// The principled surface against what Burley's formulas say where they have a closed form, and against energy.
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

class Disney : public Stage {
 protected:
  /// Radiance of a point whose light comes along its normal, seen along it too.
  vec3 facing(ParamList params) {
    shading.reset();
    scene.objects.clear();
    scene.lights.clear();
    attributes.lights.clear();
    surface("disney", std::move(params));
    light("distantlight");
    return shadeOne();
  }
};

TEST_F(Disney, WithoutSpecularIsMatteAtNormalIncidence) {
  attributes.color = {0.8f, 0.4f, 0.2f};
  // At normal incidence all Fresnel weights vanish but those of the light's own direction.
  expectColor(facing({number("specular", 0)}), attributes.color, 1e-5f);
}

TEST_F(Disney, TakesSpecularThoughAnOutputHasThatNameToo) {
  facing({number("specular", 1)});
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(Disney, TheSpecularLobeHasTheHeightOfItsDistribution) {
  attributes.color = vec3(0.0f);
  const float rough = 0.5f, alpha = rough * rough;
  // f = D G F with D = 1 / (pi a^2), G = 1 / 4 (Smith's two factors, each 1 / 2), F = 0.08 specular; light is E/pi.
  expectColor(facing({number("specular", 0.5f), number("roughness", rough)}), vec3(0.04f / (4 * alpha * alpha)), 1e-4f);
  attributes.color = {1, 0.5f, 0.25f};
  expectColor(facing({number("metallic", 1), number("roughness", rough)}), attributes.color * (1 / (4 * alpha * alpha)),
              1e-3f);
}

TEST_F(Disney, LightsThatAreNoSpecularLeaveTheMattePart) {
  attributes.color = vec3(0.5f);
  surface("disney", {number("specular", 1)});
  light("distantlight", {number("__nonspecular", 1)});
  expectColor(shadeOne(), vec3(0.5f), 1e-5f);
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  shading.reset();
  scene.objects.clear();
  scene.lights.clear();
  attributes.lights.clear();
  light("distantlight");
  expectColor(shadeOne(gather), vec3(0.5f), 1e-5f);
}

// Under light of 1 from everywhere nothing gives back more than it gets.
TEST_F(Disney, ReflectsNoMoreThanItGets) {
  attributes.color = vec3(1.0f);
  for (const float rough : {0.3f, 0.6f, 1.0f})
    for (const float metal : {0.0f, 1.0f}) {
      shading.reset();
      scene.objects.clear();
      scene.lights.clear();
      attributes.lights.clear();
      surface("disney", {number("roughness", rough), number("metallic", metal)});
      light("environmentlight", {number("samples", 1024)});
      const float L = shadeOne().x;
      EXPECT_LT(L, 1.06f) << rough << " " << metal;  // Burley's diffuse part is not normalised
      EXPECT_GT(L, 0.3f) << rough << " " << metal;
    }
}

// At roughness 1 the distribution is even and each Smith factor 1 / (1 + n.v): what a metal gives back along its normal
// is the integral of c / (1 + c), 1 - ln 2.
TEST_F(Disney, TheRoughestMetalGivesBackWhatItsIntegralSays) {
  surface("disney", {number("roughness", 1), number("metallic", 1)});
  light("environmentlight", {number("samples", 4096)});
  EXPECT_NEAR(shadeOne().x, 1 - std::log(2.0f), 3e-3f);
}

// A world of 1 all around is the same whether it is a sky, of which light and lobes are sampled, or what reflected rays
// see.
TEST_F(Disney, ReflectedRaysTellOfTheSameWorldAsHighlights) {
  services.met = [](const vec3&, const vec3&) { return 1.0f; };
  services.seen = [](const vec3&) { return vec3(1.0f); };
  for (const float rough : {0.1f, 0.5f, 1.0f})
    for (const float coat : {0.0f, 1.0f}) {
      const ParamList look{number("metallic", 1), number("roughness", rough), number("clearcoat", coat),
                           number("reflections", 2048)};
      shading.reset();
      scene.objects.clear();
      scene.lights.clear();
      attributes.lights.clear();
      surface("disney", look);
      const float mirrored = shadeOne().x;
      shading.reset();
      scene.objects.clear();
      surface("disney", {look.begin(), look.end() - 1});
      light("environmentlight", {number("samples", 2048)});
      EXPECT_NEAR(shadeOne().x, mirrored, 0.01f) << rough << " " << coat;
      if (rough == 1 && coat == 0) {
        EXPECT_NEAR(mirrored, 1 - std::log(2.0f), 5e-3f);
      }
    }
}

// A sharp lobe under a wide sky: samples of the sky alone would hardly ever meet it.
TEST_F(Disney, ASharpLobeUnderASkyIsFreeOfNoise) {
  surface("disney", {number("metallic", 1), number("roughness", 0.1f)});
  light("environmentlight", {number("samples", 16)});
  const ShadedPoints seen = shade(points(std::vector<vec3>(200, vec3(0, 0, 5))));
  double mean = 0, square = 0;
  for (int i = 0; i < 200; ++i) {
    mean += double{seen.color(i).x} / 200;
    square += std::pow(double{seen.color(i).x} - 1, 2) / 200;
  }
  EXPECT_NEAR(mean, 1, 0.02);
  EXPECT_LT(std::sqrt(square), 0.06);
}

// Metal shows nothing but its lobes, so that it draws more directions of them than paint does.
TEST_F(Disney, MetalBelowAHalfHiddenSkyHasLittleNoise) {
  services.visible = [](const vec3&, const vec3& d) { return d.x > 0.02f * glm::length(d) ? 0.0f : 1.0f; };
  light("environmentlight", {number("samples", 32)});
  const auto noiseOf = [&](float metal) {
    shading.reset();
    scene.objects.clear();
    surface("disney", {number("metallic", metal), number("roughness", 0.35f)});
    const ShadedPoints seen = shade(points(std::vector<vec3>(400, vec3(0, 0, 5))));
    double mean = 0, square = 0;
    for (int i = 0; i < 400; ++i) {
      mean += double{seen.color(i).x} / 400;
      square += double{seen.color(i).x * seen.color(i).x} / 400;
    }
    return std::sqrt(square - mean * mean) / mean;
  };
  EXPECT_LT(noiseOf(1), 1.5 * noiseOf(0));
}

// White things hide half of a white sky: where few directions find the sky, more find what hides it.
TEST_F(Disney, WhatHidesAWhiteSkyIsMirroredAlongTheSameDirections) {
  const auto hidden = [](const vec3& d) { return d.x > 0.02f; };
  services.met = [&](const vec3&, const vec3& d) { return hidden(d) ? 1.0f : kInfinity; };
  services.seen = [&](const vec3& d) { return vec3(hidden(d) ? 1.0f : 0.0f); };
  services.visible = [&](const vec3&, const vec3& d) { return hidden(d) ? 0.0f : 1.0f; };
  surface("disney", {number("metallic", 1), number("roughness", 0.3f), number("reflections", 8)});
  light("environmentlight", {number("samples", 64)});
  const ShadedPoints seen = shade(points(std::vector<vec3>(200, vec3(0, 0, 5))));
  double mean = 0, square = 0;
  for (int i = 0; i < 200; ++i) {
    mean += double{seen.color(i).x} / 200;
    square += std::pow(double{seen.color(i).x} - 1, 2) / 200;
  }
  EXPECT_NEAR(mean, 1, 0.01);
  EXPECT_LT(std::sqrt(square), 0.03) << "0.09 by 8 directions of their own";
}

// A coat reflects a few hundredths of the light, so that most of what it meets is left out.
TEST_F(Disney, WhatIsMirroredInPartIsRightInTheMean) {
  attributes.color = vec3(0.0f);
  services.met = [](const vec3&, const vec3& d) { return d.x > 0 ? 1.0f : kInfinity; };
  services.seen = [](const vec3& d) { return d.x > 0 ? vec3(1 + d.x + 2 * d.y) : vec3(0.0f); };
  const auto meanOf = [&](float rays, int n) {
    shading.reset();
    scene.objects.clear();
    services.asked.clear();
    scene.lights.clear();
    attributes.lights.clear();
    surface("disney", {number("roughness", 0.5f), number("clearcoat", 1), number("reflections", rays)});
    light("environmentlight", {number("intensity", 0), number("samples", 128)});
    const ShadedPoints seen = shade(points(std::vector<vec3>(static_cast<size_t>(n), vec3(0.5f, 0.4f, 5))));
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += double{seen.color(i).x} / n;
    return sum;
  };
  const double many = meanOf(4096, 20), few = meanOf(4, 3000);
  EXPECT_NEAR(few, many, 0.03 * many);
  meanOf(4, 1);
  EXPECT_LT(services.asked.size(), 128u + 32) << "few hits are shaded";
}

TEST_F(Disney, BitsDoNotDependOnTheCompanyOfAPoint) {
  surface("disney", {number("reflections", 8)});
  light("environmentlight");
  primvar("roughness", ValueType::Float);
  primvar("metallic", ValueType::Float);
  services.seen = [](const vec3& d) { return d * d; };
  ShadePoints all = points(std::vector<vec3>(300, vec3(0.3f, 0.4f, 5)));
  for (int i = 0; i < 300; ++i) all.primvar(0)[i] = all.primvar(1)[i] = static_cast<float>(i) / 300;
  const ShadedPoints together = shade(all);
  for (const int i : {0, 100, 299}) {
    ShadePoints alone(0, 2);
    alone.add(all.key(i));
    for (int c = 0; c < all.channelCount(); ++c) alone.channel(c)[0] = all.channel(c)[i];
    EXPECT_EQ(shade(alone).color(0), together.color(i)) << i;
  }
  EXPECT_NE(together.color(100), together.color(101));
}

TEST_F(Disney, EmissionAndReflectionsAreAdded) {
  attributes.color = vec3(0.0f);
  expectColor(facing({number("specular", 0), color("emission", {1, 2, 3})}), {1, 2, 3});
  const size_t before = services.asked.size();
  services.met = [](const vec3&, const vec3&) { return 1.0f; };
  attributes.color = vec3(1.0f);
  facing({number("metallic", 1), number("reflections", 4)});
  ASSERT_EQ(services.asked.size(), before + 8) << "four distances, and four colours";
  EXPECT_EQ(services.asked.back().number, 3);
  EXPECT_EQ(services.asked.back().count, 4);
  EXPECT_FALSE(services.asked.back().seesAreaLights) << "light samples bring them";
}

}  // namespace
}  // namespace tomales
