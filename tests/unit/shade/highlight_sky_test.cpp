// Highlights of lights that have an extent, against integrals.
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

constexpr float kSharpness = 8;  // docs/decisions/0004: roughness r means the exponent 8 / r of N.H

class WideHighlight : public Stage {
 protected:
  /// The highlight of points that are seen from V, in the mean.
  vec3 highlight(float roughness, const vec3& V, int samples, int count = 512) {
    surface("plastic", {number("Kd", 0), number("Ka", 0), number("Ks", 1), number("roughness", roughness)});
    ShadePoints p = points(std::vector<vec3>(static_cast<size_t>(count), vec3(0, 0, 5)));
    for (int i = 0; i < count; ++i) p.set3(kIx, i, -V);
    ShadeContext context;
    context.lightSamples = samples;
    const ShadedPoints out = shade(p, context);
    vec3 sum(0);
    for (int i = 0; i < count; ++i) sum += out.color(i) / static_cast<float>(count);
    return sum;
  }
  /// The integral of (N.H)^e over the directions L in front, over pi, where counts(L) holds; N = (0, 0, -1).
  static double integral(float roughness, const vec3& V, const std::function<bool(const vec3&)>& counts) {
    const double e = kSharpness / roughness;
    const vec3 N(0, 0, -1);
    double sum = 0;
    constexpr int kRings = 800, kSectors = 800;
    for (int j = 0; j < kRings; ++j)
      for (int k = 0; k < kSectors; ++k) {
        const double z = (j + 0.5) / kRings, phi = 2 * M_PI * (k + 0.5) / kSectors, r = std::sqrt(1 - z * z);
        const vec3 L(r * std::cos(phi), r * std::sin(phi), -z);
        if (counts(L)) sum += std::pow(std::max(0.0, double{dot(N, glm::normalize(L + V))}), e);
      }
    return sum * 2 * M_PI / (kRings * kSectors) / M_PI;
  }
};

// With V = N, N.H is the cosine of half the angle: the integral is 8 / (e + 2) (1 - 2^(-(e + 2) / 2)).
TEST_F(WideHighlight, OfAnEvenSkyHasItsClosedForm) {
  light("environmentlight", {number("intensity", 2), color("lightcolor", {1, 0.5f, 0.25f})});
  for (const float roughness : {0.02f, 0.1f, 1.0f, 5.0f}) {
    shading.reset();
    scene.objects.clear();
    const float e = kSharpness / roughness, expected = 8 / (e + 2) * (1 - std::pow(2.0f, -(e + 2) / 2));
    expectColor(highlight(roughness, {0, 0, -1}, 16), 2 * expected * vec3(1, 0.5f, 0.25f), 0.01f * expected);
  }
}

// The light of a photon map has no direction.
TEST_F(WideHighlight, OfStoredLightIsThatOfAnEvenSky) {
  surface("plastic", {number("Kd", 0), number("Ka", 0), number("Ks", 1), number("roughness", 8)});
  services.stored = vec3(2);
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  gather.illumination = Illumination::LightsAndStored;
  gather.highlights = HitHighlights::OfSpecular;
  expectColor(shadeOne(gather), vec3(2 * 8.0f / 3 * (1 - std::pow(2.0f, -1.5f))));
}

TEST_F(WideHighlight, OfASkyIsItsIntegralFromTheSideToo) {
  light("environmentlight");
  const vec3 V = glm::normalize(vec3(0.6f, 0.3f, -0.5f));
  for (const float roughness : {0.1f, 0.7f}) {
    shading.reset();
    scene.objects.clear();
    const double expected = integral(roughness, V, [](const vec3&) { return true; });
    EXPECT_NEAR(highlight(roughness, V, 32).x, expected, 0.01 * expected) << roughness;
  }
}

TEST_F(WideHighlight, OfASkyIsShadowedDirectionByDirection) {
  light("environmentlight");
  const vec3 V = glm::normalize(vec3(0.4f, 0, -0.8f));
  const auto open = [](const vec3& L) { return L.x > -0.3f; };
  services.visible = [&](const vec3&, const vec3& toward) { return open(glm::normalize(toward)) ? 1.0f : 0.0f; };
  const double expected = integral(0.4f, V, open);
  EXPECT_NEAR(highlight(0.4f, V, 32).x, expected, 0.015 * expected);
}

TEST_F(WideHighlight, OfALampThatIsNoSpecularIsDark) {
  light("environmentlight", {number("__nonspecular", 1)});
  EXPECT_EQ(highlight(0.4f, {0, 0, -1}, 4), vec3(0));
}

TEST_F(WideHighlight, OfFewSamplesHasLittleNoiseWhereTheLobeIsNarrow) {
  light("environmentlight");
  surface("plastic", {number("Kd", 0), number("Ka", 0), number("Ks", 1), number("roughness", 0.01f)});
  ShadePoints p = points(std::vector<vec3>(64, vec3(0, 0, 5)));
  ShadeContext context;
  context.lightSamples = 8;
  const ShadedPoints out = shade(p, context);
  const double e = kSharpness / 0.01, expected = 8 / (e + 2);
  double squares = 0;
  for (int i = 0; i < 64; ++i) squares += std::pow(out.color(i).x / expected - 1, 2) / 64;
  EXPECT_LT(std::sqrt(squares), 0.15) << "by the cosine alone it would be 3";
}

// Few samples of a sky fall into a lobe, so its own directions count more.
TEST_F(WideHighlight, OfAHalfHiddenSkyIsFoundByTheLobe) {
  light("environmentlight");
  services.visible = [](const vec3&, const vec3& toward) { return toward.x < 0 ? 1.0f : 0.0f; };
  surface("plastic", {number("Kd", 0), number("Ka", 0), number("Ks", 1), number("roughness", 0.02f)});
  ShadeContext context;
  context.lightSamples = 64;
  const ShadedPoints out = shade(points(std::vector<vec3>(400, vec3(0, 0, 5))), context);
  const double e = kSharpness / 0.02, expected = 4 / (e + 2);
  double squares = 0;
  for (int i = 0; i < 400; ++i) squares += std::pow(out.color(i).x / expected - 1, 2) / 400;
  EXPECT_LT(std::sqrt(squares), 0.025);
}

}  // namespace
}  // namespace tomales
