// The principled surface against what Burley's formulas say where they have a closed form, and against energy.
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

class Disney : public Stage {
 protected:
  /// Radiance of a point whose light comes along its normal, seen along it too.
  vec3 facing(ParamList params) {
    shading.reset(), scene.objects.clear(), scene.lights.clear(), attributes.lights.clear();
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

TEST_F(Disney, TheSpecularLobeHasTheHeightOfItsDistribution) {
  attributes.color = vec3(0.0f);
  const float rough = 0.5f, alpha = rough * rough;
  // f = D G F with D = 1 / (pi a^2), G = 1 / 4 (Smith's two factors, each 1 / 2), F = 0.08 specular; light is E/pi.
  expectColor(facing({number("specular", 0.5f), number("roughness", rough)}), vec3(0.04f / (4 * alpha * alpha)), 1e-4f);
  attributes.color = {1, 0.5f, 0.25f};
  expectColor(facing({number("metallic", 1), number("roughness", rough)}), attributes.color * (1 / (4 * alpha * alpha)), 1e-3f);
}

TEST_F(Disney, LightsThatAreNoSpecularLeaveTheMattePart) {
  attributes.color = vec3(0.5f);
  surface("disney", {number("specular", 1)});
  light("distantlight", {number("__nonspecular", 1)});
  expectColor(shadeOne(), vec3(0.5f), 1e-5f);
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  shading.reset(), scene.objects.clear(), scene.lights.clear(), attributes.lights.clear();
  light("distantlight");
  expectColor(shadeOne(gather), vec3(0.5f), 1e-5f);
}

// Under light of 1 from everywhere nothing gives back more than it gets.
TEST_F(Disney, ReflectsNoMoreThanItGets) {
  attributes.color = vec3(1.0f);
  for (const float rough : {0.3f, 0.6f, 1.0f})
    for (const float metal : {0.0f, 1.0f}) {
      shading.reset(), scene.objects.clear(), scene.lights.clear(), attributes.lights.clear();
      surface("disney", {number("roughness", rough), number("metallic", metal)});
      light("environmentlight", {number("samples", 1024)});
      const float L = shadeOne().x;
      EXPECT_LT(L, 1.06f) << rough << " " << metal;  // Burley's diffuse part is not normalised
      EXPECT_GT(L, 0.3f) << rough << " " << metal;
    }
}

// At roughness 1 the distribution is even and each Smith factor 1 / (1 + n.v): what a metal gives back along its normal is the integral
// of c / (1 + c), 1 - ln 2.
TEST_F(Disney, TheRoughestMetalGivesBackWhatItsIntegralSays) {
  surface("disney", {number("roughness", 1), number("metallic", 1)});
  light("environmentlight", {number("samples", 4096)});
  EXPECT_NEAR(shadeOne().x, 1 - std::log(2.0f), 3e-3f);
}

TEST_F(Disney, EmissionAndReflectionsAreAdded) {
  attributes.color = vec3(0.0f);
  expectColor(facing({number("specular", 0), color("emission", {1, 2, 3})}), {1, 2, 3});
  const size_t before = services.asked.size();
  facing({number("reflections", 4)});
  EXPECT_EQ(services.asked.size(), before + 4);
}

}  // namespace
}  // namespace tomales
