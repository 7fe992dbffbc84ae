// Atmosphere over points and imagers over pixels, by their formulas in RISpec 3.2, appendix A.
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

class Atmosphere : public Stage {
 protected:
  void atmosphere(const std::string& name, ParamList params = {}) {
    attributes.atmosphere = std::make_shared<const ShaderCall>(call(name, std::move(params)));
  }
  /// Colour and opacity of a surface of colour 0.5 at P, seen through the air.
  ShadedPoints seen(const vec3& P) {
    attributes.color = vec3(0.5f);
    surface("constant");
    ShadePoints p = points({P});
    p.set3(kIx, 0, P);
    ShadedPoints out = shade(p);
    system().atmosphere(p, out);
    return out;
  }
};

TEST_F(Atmosphere, ClearAirChangesNothing) { expectColor(seen({0, 0, 5}).color(0), vec3(0.5f), 0); }

TEST_F(Atmosphere, FogFadesWithTheDistanceToTheEye) {
  scene.options.projection = ProjectionKind::Perspective;
  atmosphere("fog", {number("distance", 10), color("background", {0.2f, 0.4f, 1})});
  attributes.opacity = vec3(0.5f);
  const float d = 1 - std::exp(-0.5f);
  const ShadedPoints out = seen({3, 0, 4});
  expectColor(out.color(0), 0.25f * (1 - d) + d * vec3(0.2f, 0.4f, 1));
  expectColor(out.opacity(0), vec3(0.5f * (1 - d) + d));
}

TEST_F(Atmosphere, WhatIsAirBesideATransparentSurfaceIsKnown) {
  scene.options.projection = ProjectionKind::Perspective;
  atmosphere("fog", {number("distance", 10), color("background", {0.2f, 0.4f, 1})});
  attributes.opacity = vec3(0.25f, 0.5f, 1);
  const float d = 1 - std::exp(-0.5f);
  const ShadedPoints out = seen({3, 0, 4});
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(out.airCi[k][0], (1 - attributes.opacity[k]) * d * vec3(0.2f, 0.4f, 1)[k], 1e-6);
    EXPECT_NEAR(out.airOi[k][0], (1 - attributes.opacity[k]) * d, 1e-6);
  }
}

TEST_F(Atmosphere, VolumesLieBeforeTheSurfaceAndBehindTheFog) {
  for (const bool volume : {false, true}) {  // any object of the scene may be a Volume
    auto other = std::make_shared<Attributes>();
    other->volume = volume;
    other->color = vec3(volume ? 1 : 0);
    Object o;
    o.shapes = {std::make_shared<BlankPrim>(std::vector<Primvar>{})};
    o.attributes = other;
    o.where = at(9);
    scene.objects.push_back(o);
  }
  attributes.color = vec3(0.5f);
  attributes.opacity = vec3(0.5f);
  surface("constant");
  const vec3 Ci(0.1f, 0.2f, 0.3f), Oi(0.5f, 0.25f, 0);
  services.volumes = std::pair(Ci, Oi);
  system();
  ShadePoints p(scene.objects[2].group, 0);
  p.add(1);
  for (const int channel : {kPx, kIx}) p.set3(channel, 0, {0, 0, 5});
  for (const int channel : {kNx, kNgx}) p.set3(channel, 0, {0, 0, -1});
  ShadedPoints out = shade(p);
  system().atmosphere(p, out);
  expectColor(out.color(0), Ci + (1.0f - Oi) * vec3(0.25f));
  expectColor(out.opacity(0), 1.0f - (1.0f - Oi) * vec3(0.5f));
  for (int k = 0; k < 3; ++k) {  // beside the surface
    EXPECT_NEAR(out.airCi[k][0], 0.5f * Ci[k], 1e-6f);
    EXPECT_NEAR(out.airOi[k][0], 0.5f * Oi[k], 1e-6f);
  }
}

TEST_F(Atmosphere, NoAirIsKeptWhereNothingIsTransparent) {
  atmosphere("fog", {number("distance", 10)});
  EXPECT_TRUE(seen({3, 0, 4}).airCi[0].empty());
}

TEST_F(Atmosphere, FogIsMeasuredInDepthWhereRaysAreParallel) {
  scene.options.projection = ProjectionKind::Orthographic;
  atmosphere("fog", {number("distance", 10)});
  expectColor(seen({3, 0, 4}).color(0), vec3(0.5f * std::exp(-0.4f)));
}

TEST_F(Atmosphere, DepthcueIsLinearBetweenTheClippingPlanes) {
  scene.options.nearClip = 2;
  scene.options.farClip = 12;
  atmosphere("depthcue", {number("mindistance", 0.2f), color("background", {1, 0, 0})});
  const float d = (0.6f - 0.2f) / 0.8f;
  expectColor(seen({0, 0, 8}).color(0), glm::mix(vec3(0.5f), vec3(1, 0, 0), d));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Atmosphere, DepthcueWithoutClippingSaysWhyItDoesNothing) {
  atmosphere("depthcue");
  expectColor(seen({0, 0, 8}).color(0), vec3(0.5f));
  EXPECT_EQ(log.entries().size(), 1u);
}

void choke(const TmGrid* g) {
  g->Ci.x[0] = 77;
  throw std::runtime_error("no air");
}

TEST_F(Atmosphere, OneThatThrowsChangesNothing) {
  static const rsl::Shader choking(TM_VOLUME, "choking", "", 0, choke, {});
  static const TmShader* const shaders[] = {choking};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  atmosphere("choking");
  attributes.opacity = vec3(0.5f);
  const ShadedPoints out = seen({0, 0, 8});
  expectColor(out.color(0), vec3(0.25f), 0);
  EXPECT_TRUE(out.airCi[0].empty());
  EXPECT_EQ(log.count("shader-exception"), 1);
}

void poison(const TmGrid* g) { g->Ci.y[0] = std::nanf(""); }

TEST_F(Atmosphere, WhereItIsNotFiniteTheColourIsBlackAndItIsSaid) {
  static const rsl::Shader poisoning(TM_VOLUME, "poisoning", "", 0, poison, {});
  static const TmShader* const shaders[] = {poisoning};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  atmosphere("poisoning");
  expectColor(seen({0, 0, 8}).color(0), vec3(0), 0);
  EXPECT_EQ(log.count("shader-not-finite"), 1);
}

TEST_F(Atmosphere, AnUnknownOneIsReportedAndTheAirIsClear) {
  atmosphere("nosuch");
  expectColor(seen({0, 0, 8}).color(0), vec3(0.5f));
  EXPECT_EQ(log.worst(), Severity::Missing);
}

class Imager : public Stage {
 protected:
  ShadedPixels run(const std::string& name, ParamList params = {}) {
    scene.options.imager = call(name, std::move(params));
    ShadedPixels p;
    p.x = 10.5f;
    p.y = 3.5f;
    p.count = 2;
    p.colors.resize(2);
    p.alpha.assign(p.colors.Ci[0].size(), 0.25f);
    for (int c = 0; c < 3; ++c) p.colors.Ci[c][0] = 0.5f;
    system().image(p);
    return p;
  }
};

TEST_F(Imager, BackgroundFillsWhatAlphaLeavesUnderEitherName) {
  for (const char* name : {"background", "bgcolor"}) {
    shading.reset();
    scene.objects.clear();
    const ShadedPixels p = run("background", {color(name, {0.1f, 0.2f, 0.4f})});
    expectColor(p.colors.color(0), vec3(0.5f) + 0.75f * vec3(0.1f, 0.2f, 0.4f));
    EXPECT_EQ(p.alpha[0], 1);
  }
}

TEST_F(Imager, BackgroundLeavesAlphaAsItIsWithoutAnAlphaOfItsOwn) {
  for (const auto& [own, alpha] : {std::pair{0.0f, 0.25f}, {0.5f, 0.625f}, {1.0f, 1.0f}}) {
    shading.reset();
    scene.objects.clear();
    const ShadedPixels p = run("background", {color("color", {0.1f, 0.2f, 0.4f}), number("alpha", own)});
    expectColor(p.colors.color(0), vec3(0.5f) + 0.75f * vec3(0.1f, 0.2f, 0.4f));
    EXPECT_EQ(p.alpha[0], alpha);
  }
}

TEST_F(Imager, ClampToAlphaLimitsColour) {
  const ShadedPixels p = run("clamptoalpha");
  expectColor(p.colors.color(0), vec3(0.25f), 0);
  expectColor(p.colors.color(1), vec3(0.0f), 0);
  EXPECT_EQ(p.alpha[0], 0.25f);
}

void showPosition(const TmGrid* g) {
  for (int i : rsl::Batch(g)) rsl::set(g->Ci, i, rsl::get(g->P, i));
}
void throwUp(const TmGrid* g) {
  g->Ci.x[0] = 77;
  throw std::runtime_error("no");
}

TEST_F(Imager, SeesRasterPositionsAndOneThatThrowsChangesNothing) {
  static const rsl::Shader place(TM_IMAGER, "place", "", 0, showPosition, {});
  static const rsl::Shader thrower(TM_IMAGER, "thrower", "", 0, throwUp, {});
  static const TmShader* const shaders[] = {place, thrower};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  EXPECT_FALSE(system().hasImager());
  shading.reset();
  scene.objects.clear();
  expectColor(run("place").colors.color(1), {11.5f, 3.5f, 0}, 0);
  EXPECT_TRUE(system().hasImager());
  shading.reset();
  scene.objects.clear();
  expectColor(run("thrower").colors.color(0), vec3(0.5f), 0);
}

TEST_F(Imager, AnUnknownOneIsReportedAndNoneRuns) {
  scene.options.imager = call("nosuch", {});
  EXPECT_FALSE(system().hasImager());
  EXPECT_EQ(log.worst(), Severity::Missing);
}

}  // namespace
}  // namespace tomales
