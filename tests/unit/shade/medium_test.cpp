// The volume shader medium against closed forms: what passes a layer, and what it scatters to the eye.
#include "reyes/density.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

ParamList even(float scattering, float absorption, ParamList more = {}) {
  more.push_back(color("scattering", vec3(scattering)));
  more.push_back(color("absorption", vec3(absorption)));
  return more;
}

class Medium : public Stage {
 protected:
  /// What is seen of a surface of this radiance at z = `depth` through it.
  vec3 seen(float depth, ParamList params, const vec3& behind = vec3(0)) {
    attributes.atmosphere = std::make_shared<const ShaderCall>(call("medium", std::move(params)));
    const ShadePoints p = points({vec3(0, 0, depth)});
    ShadedPoints out;
    out.resize(1);
    out.set(0, behind, vec3(1));
    shading.reset();
    scene.objects.clear();
    scene.groups.clear();
    system().atmosphere(p, out);
    EXPECT_EQ(log.entries().size(), 0u);
    return out.color(0);
  }
};

TEST_F(Medium, AbsorbsAsBeerAndLambertSay) {
  const vec3 out = seen(3, {color("scattering", vec3(0)), color("absorption", {0.1f, 0.5f, 2})}, vec3(1));
  expectColor(out, {std::exp(-0.3f), std::exp(-1.5f), std::exp(-6.0f)});
}

TEST_F(Medium, AbsorbsByTheColumnOfDensityThatARayCrosses) {
  attributes.interior = std::make_shared<const ShaderCall>(call("medium", even(0, 0.5f)));
  // The first ray meets a density of 3 between 1 and 2, the other one nothing.
  const std::vector<DensityAlongRay> ways = {{{{0, 0}, {1, 0}, {2, 3}, {4, 3}}}, {{{0, 0}, {4, 0}}}};
  ShadeContext context;
  context.densities = ways;
  ShadePoints ends = points({vec3(0, 0, 4), vec3(0, 0, 4)});
  for (int i = 0; i < 2; ++i) ends.set3(kIx, i, {0, 0, 4});
  ShadedPoints out;
  out.resize(2);
  for (int i = 0; i < 2; ++i) out.set(i, vec3(1), vec3(1));
  EXPECT_FALSE(system().crossVolume(ends, false, context, out));
  EXPECT_EQ(out.color(0), vec3(1));
  EXPECT_TRUE(system().crossVolume(ends, true, context, out));
  expectColor(out.color(0), vec3(std::exp(-1.5f)));
  expectColor(out.color(1), vec3(1));
}

TEST_F(Medium, ScattersFromWhereTheDensityIs) {
  // What is scattered in a thin layer at 3 has been absorbed nowhere before, and the lamp's light falls off from there.
  light("pointlight", {number("intensity", 10), point("from", {0, 2, 3})});
  attributes.interior = std::make_shared<const ShaderCall>(call("medium", even(0.01f, 0, {number("steps", 64)})));
  const std::vector<DensityAlongRay> ways = {{{{0, 0}, {2.99f, 0}, {3.01f, 1}, {4, 1}}}};
  ShadeContext context;
  context.densities = ways;
  ShadePoints ends = points({vec3(0, 0, 4)});
  ends.set3(kIx, 0, {0, 0, 4});
  ShadedPoints out;
  out.resize(1);
  out.set(0, vec3(0), vec3(1));
  EXPECT_TRUE(system().crossVolume(ends, true, context, out));
  expectColor(out.color(0), vec3(10 / 4.0f / 4 * -std::expm1(-0.01f)), 8e-5f);
}

TEST_F(Medium, CannotBeSeenInAFurnace) {
  light("ambientlight");
  for (const float depth : {1e-6f, 0.01f, 1.0f, 100.0f}) expectColor(seen(depth, even(0.7f, 0), vec3(1)), vec3(1));
}

TEST_F(Medium, CannotBeSeenUnderAnEvenSkyHoweverItScatters) {
  light("environmentlight", {number("samples", 1024)});
  for (const float g : {0.0f, 0.5f, -0.7f})
    expectColor(seen(2, even(0.7f, 0, {number("anisotropy", g)}), vec3(1)), vec3(1), 0.01f);
}

TEST_F(Medium, ScattersOnceInProportionToWhatItStops) {
  light("distantlight", {point("to", {0, -1, 0}), number("intensity", 2)});
  for (const float depth : {1e-5f, 0.5f, 5.0f})
    expectColor(seen(depth, even(0.3f, 0.2f)), vec3(2 / 4.0f * 0.6f * -std::expm1(-0.5f * depth)), 1e-6f);
}

TEST_F(Medium, TakesEachChannelByItself) {
  light("distantlight", {point("to", {0, -1, 0})});
  const vec3 s{0.1f, 0.4f, 2}, a{0.1f, 0, 0.5f};
  const vec3 out = seen(2, {color("scattering", s), color("absorption", a), number("steps", 256)});
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(out[c], s[c] / (s[c] + a[c]) / 4 * -std::expm1(-2 * (s[c] + a[c])), 2e-4f) << "channel " << c;
}

// L. Henyey and J. Greenstein: (1 - g^2) / (1 + g^2 - 2 g cos)^1.5 times what is scattered evenly.
TEST_F(Medium, ScattersByThePhaseFunction) {
  const auto towards = [&](const vec3& to, float g) {
    scene.lights.clear();
    attributes.lights.clear();
    light("distantlight", {point("to", to)});
    return seen(1, even(1, 0, {number("anisotropy", g)})).x;
  };
  for (const float g : {-0.6f, 0.3f, 0.9f})
    for (const float cosine : {-1.0f, 0.0f, 0.5f, 1.0f}) {
      const vec3 to{std::sqrt(1 - cosine * cosine), 0, -cosine};
      const float bend = 1 + g * g - 2 * g * cosine;
      EXPECT_NEAR(towards(to, g) / towards(to, 0), (1 - g * g) / std::pow(bend, 1.5f), 1e-3f / bend)
          << g << ' ' << cosine;
    }
}

TEST_F(Medium, DimsLightOnItsWay) {
  light("distantlight", {point("to", {0, -1, 0})});
  const float once = 0.25f * -std::expm1(-1.0f);
  expectColor(seen(2, even(0.5f, 0, {number("lightway", 3)})), vec3(once * std::exp(-1.5f)));
  expectColor(seen(2, even(0.5f, 0)), vec3(once));
}

// A lamp at distance h beside the ray: the integral of s exp(-s (z + d)) / (4 d^2), d^2 = h^2 + (z - z0)^2.
TEST_F(Medium, ALampInItIsDimmedByItsDistance) {
  constexpr double kBeside = 1.5, kAt = 2, kDepth = 5, kSigma = 0.4;
  light("pointlight", {point("from", {float{kBeside}, 0, float{kAt}})});
  double expected = 0;
  constexpr int kParts = 20000;
  for (int i = 0; i < kParts; ++i) {
    const double z = (i + 0.5) * kDepth / kParts, d = std::hypot(kBeside, z - kAt);
    expected += kSigma * std::exp(-kSigma * (z + d)) / (4 * d * d) * kDepth / kParts;
  }
  const ParamList dimmed{number("lightway", 1e30f), number("steps", 1024)};
  expectColor(seen(5, even(0.4f, 0, dimmed)), vec3(float(expected)), 1e-4f);
}

// Places are chosen where the lamp is near, so few of them do even if the ray passes close by.
TEST_F(Medium, ALampBesideTheRayNeedsFewSteps) {
  constexpr double kBeside = 0.01, kAt = 2, kDepth = 5, kSigma = 0.01;
  light("pointlight", {point("from", {float{kBeside}, 0, float{kAt}})});
  const double dimmed = std::exp(-kSigma * kAt);  // nearly all comes from beside the lamp
  const double expected =
      dimmed * kSigma / 4 * (std::atan((kDepth - kAt) / kBeside) + std::atan(kAt / kBeside)) / kBeside;
  EXPECT_NEAR(seen(5, even(0.01f, 0, {number("steps", 16)})).x / expected, 1, 0.02);
}

TEST_F(Medium, CountsInUnitsOfTheWorld) {
  scene.cameraFromWorld = Motion::still(mat4(4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1));
  light("distantlight", {point("to", {0, -1, 0})});
  expectColor(seen(8, even(0.5f, 0), vec3(1)), vec3(std::exp(-1.0f) + 0.25f * -std::expm1(-1.0f)));
}

}  // namespace
}  // namespace tomales
