// Photons in scenes of which the light at every point is known.
#include "gi/photons.h"

#include <gtest/gtest.h>

#include "reyes/base/parallel.h"
#include "tests/unit/gi/photon_scenes.h"

namespace tomales {
namespace {

using namespace test;

TEST(Photons, AllThatALightSendsIntoAClosedSphereArrives) {
  World world(insideOfASphere());
  EXPECT_NEAR(powerOf(traced(world, {20000, 1})), kSpherePower, 0.002 * kSpherePower);
}

TEST(Photons, StoredPowerIsTheGeometricSeriesOfTheAlbedo) {
  World world(insideOfASphere());
  EXPECT_NEAR(powerOf(traced(world, {200000, 40})), kSpherePower / (1 - double{kSphereAlbedo}),
              0.005 * kSpherePower / (1 - double{kSphereAlbedo}));
}

// Half of it is left after the first bounce, a quarter after the second.
TEST(Photons, AreEnoughOrItIsSaidHowMuchLightIsLeft) {
  World world(insideOfASphere());
  for (const auto& [bounces, left] : {std::pair(2, 0.5), {3, 0.25}, {5, 0.0625}}) {
    const PhotonFigures figures = tracePhotons(
        world.scene, world.rays, world.shading, {100000, bounces, 0, false}, [](auto) {}, {}, world.stats, world.log);
    EXPECT_NEAR(figures.left, left, 0.1 * left) << bounces;
  }
  EXPECT_EQ(world.log.count("photons-bounces"), 3);
  EXPECT_EQ(world.log.worst(), Severity::Note) << "somebody asked for so few";
  const double all = kSpherePower * double{kSphereAlbedo} / (1 - double{kSphereAlbedo});
  EXPECT_NEAR(powerOf(traced(world, {100000, 0, 0, false})), all, 0.01 * all) << "without a number they go on";
}

TEST(Photons, InARoomThatKeepsItsLightEndWithAWarning) {
  Scene scene = insideOfASphere();
  auto white = std::make_shared<Attributes>(*scene.objects[0].attributes);
  white->color = vec3(0.98f);
  scene.objects[0].attributes = white;
  World world(std::move(scene));
  traced(world, {2000, 0, 0, false});
  EXPECT_EQ(world.log.worst(), Severity::Warning);
  EXPECT_EQ(world.log.count("photons-bounces"), 1);
}

TEST(Photons, WithoutThoseStraightFromLightsAreWhatSurfacesSendOn) {
  World world(insideOfASphere());
  const double expected = kSpherePower * double{kSphereAlbedo} / (1 - double{kSphereAlbedo});
  EXPECT_NEAR(powerOf(traced(world, {200000, 40, 0, false})), expected, 0.005 * expected);
}

TEST(Photons, ThroughWhatShadowRaysPassComeStraight) {
  SceneBuilder b;
  b.light("distantlight", {floatParam("intensity", 2), pointParam("from", {0, 0, 0}), pointParam("to", {0, 0, 1})});
  for (const float z : {4.0f, 5.0f}) b.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}, vec3(1));
  auto sheet = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  sheet->photon.shadingModel = "transparent";
  b.scene.objects[0].attributes = sheet;
  World world(b.scene);
  EXPECT_NEAR(powerOf(traced(world, {20000, 2})), 2 * double{kPi} * 4, 0.02 * 8 * double{kPi});
  EXPECT_TRUE(traced(world, {20000, 2, 0, false}).empty());
}

TEST(Photons, RouletteKeepsPowersEven) {
  World world(insideOfASphere());
  const std::vector<StoredPhoton> photons = traced(world, {20000, 10});
  const auto [least, most] = std::minmax_element(photons.begin(), photons.end(),
                                                 [](const auto& a, const auto& b) { return a.power.y < b.power.y; });
  EXPECT_LT(most->power.y, 1.02f * least->power.y);
}

TEST(Photons, AreTheSameForAnyNumberOfThreads) {
  World world(insideOfASphere());
  const auto withThreads = [&](int threads) {
    const ThreadLimit limit(threads);
    return traced(world, {10000, 5});
  };
  const auto a = withThreads(1), b = withThreads(3);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i].P == b[i].P && a[i].power == b[i].power) << i;
}

TEST(Photons, GoTheSameWayWhetherASurfaceIsAskedOnceOrAtEveryHit) {
  World once(insideOfASphere());
  ASSERT_TRUE(once.shading.group(0).reflectsEvenly());
  Scene scene = insideOfASphere();
  auto attributes = std::make_shared<Attributes>(*scene.objects[0].attributes);
  attributes->surface = std::make_shared<ShaderCall>(call("plastic", {floatParam("Kd", 1)}));
  scene.objects[0].attributes = attributes;
  World each(scene);
  ASSERT_FALSE(each.shading.group(0).reflectsEvenly());
  const auto a = traced(once, {10000, 5}), b = traced(each, {10000, 5});
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i].P == b[i].P && a[i].power == b[i].power) << i;
}

TEST(Photons, AskSurfacesWhosePrimitiveVariablesColourThem) {
  SceneBuilder b;
  Problems problems;
  Param P{"P", Storage::Vertex, ValueType::Point, 1, {0, 0, 0, 1, 0, 0, 1, 1, 0}, {}, {}},
      Cs{"Cs", Storage::Vertex, ValueType::Color, 1, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {}, {}},
      Kd{"Kd", Storage::Vertex, ValueType::Float, 1, {0, 1, 0.5f}, {}, {}};
  for (const ParamList& params : {ParamList{P}, {P, Cs}, {P, Kd}})
    b.add(makePolygons({3}, {0, 1, 2}, params, problems), vec3(1));
  World world(b.scene);
  for (const auto& [object, even] : {std::pair{0, true}, {1, false}, {2, false}})
    EXPECT_EQ(world.shading.group(world.scene.objects[static_cast<size_t>(object)].group).reflectsEvenly(), even)
        << object;
}

TEST(Photons, NoneComesIntoAClosedBody) {
  SceneBuilder b;
  b.light("pointlight", {floatParam("intensity", 3), pointParam("from", {0, 0, 0})});
  b.sphere(4, vec3(0.8f), {0, 0, 0});
  b.sphere(0.5f, vec3(0.8f), {0, 0, 2});
  World world(b.scene);
  int onBall = 0, inside = 0;
  for (const StoredPhoton& p : traced(world, {50000, 10})) {
    const vec3 off = p.P - vec3(0, 0, 2);
    if (glm::length(off) > 1) continue;
    ++onBall;
    inside += dot(off, p.N) < 0;
  }
  EXPECT_GT(onBall, 1000);
  EXPECT_EQ(inside, 0);
}

TEST(Photons, NoneLeavesAClosedBoxByItsEdges) {
  // Even photons that leave a wall flat, near the edge that it shares with another wall, stay in the box.
  SceneBuilder b;
  b.light("pointlight", {floatParam("intensity", 3), pointParam("from", {0.1f, 0.2f, 3})});
  const auto box = [&](float r) {
    const auto at = [&](int i) { return vec3(i & 1 ? r : -r, i & 2 ? r : -r, (i & 4 ? r : -r) + 3); };
    constexpr int kFaces[6][4] = {{0, 4, 5, 1}, {2, 3, 7, 6}, {4, 6, 7, 5}, {0, 1, 3, 2}, {0, 2, 6, 4}, {5, 7, 3, 1}};
    for (const auto& f : kFaces) b.quad(at(f[0]), at(f[1]), at(f[2]), at(f[3]), vec3(0.75f));
  };
  box(1);
  box(3);
  World world(b.scene);
  const std::vector<StoredPhoton> photons = traced(world, {150000, 200});
  EXPECT_GT(photons.size(), 590000u);
  for (const StoredPhoton& p : photons) EXPECT_LT(maxComponent(glm::abs(p.P - vec3(0, 0, 3))), 1.001f);
}

TEST(Photons, AMirrorStoresNothing) {
  World world(insideOfASphere("chrome"));
  EXPECT_TRUE(traced(world, {1000, 5}).empty());
}

TEST(Photons, AModelThatIsNotKnownIsNamedAndMatte) {
  World world(insideOfASphere("velvet"));
  EXPECT_FALSE(traced(world, {1000, 5}).empty());
  EXPECT_EQ(world.log.count("photons-model"), 1);
}

TEST(Photons, WhatComesByAMirrorAloneIsACaustic) {
  // Light falls aslant on a mirror that lies flat, and from there on a wall, which it reaches by itself too.
  SceneBuilder b;
  b.light("distantlight", {floatParam("intensity", 2), pointParam("from", {0, 0, 0}), pointParam("to", {1, -1, 0})});
  b.quad({-1, -1, 2}, {1, -1, 2}, {1, -1, 4}, {-1, -1, 4}, vec3(1));
  b.quad({4, -6, -6}, {4, 10, -6}, {4, 10, 12}, {4, -6, 12}, vec3(0.5f));
  auto mirror = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  mirror->photon.shadingModel = "chrome";
  b.scene.objects[0].attributes = mirror;
  World world(b.scene);
  double caustic = 0;
  for (const StoredPhoton& p : traced(world, {200000, 6})) {
    EXPECT_TRUE(!p.caustic() || (p.P.y > 1.9f && p.P.y < 4.1f && p.P.z > 1.9f && p.P.z < 4.1f));
    caustic += p.caustic() ? double{p.power.y} : 0.0;
  }
  const double onMirror = 2 * double{kPi} * 4 * std::sqrt(0.5);
  EXPECT_NEAR(caustic, onMirror, 0.02 * onMirror);
}

TEST(Photons, ADistantLightIsAimedAtTheObjectsAlone) {
  SceneBuilder b;
  b.light("distantlight", {floatParam("intensity", 2), pointParam("from", {0, 0, 0}), pointParam("to", {0, 0, 1})});
  for (const float x : {-5.0f, 5.0f})  // one unit of area each, far apart
    b.quad({x, 0, 5}, {x + 1, 0, 5}, {x + 1, 1, 5}, {x, 1, 5}, vec3(0.5f));
  World world(b.scene);
  const std::vector<StoredPhoton> photons = traced(world, {20000, 1});
  EXPECT_GT(photons.size(), 14000u);  // at random over the square, 300 would arrive
  EXPECT_NEAR(powerOf(photons), 2 * double{kPi} * 2, 0.02 * 4 * double{kPi});
}

TEST(Photons, ASkyGivesAFloorPiTimesItsRadiance) {
  SceneBuilder b;
  b.light("environmentlight", {floatParam("intensity", 1.5f)});
  b.quad({-1, -1, 5}, {1, -1, 5}, {1, 1, 5}, {-1, 1, 5}, vec3(0));
  World world(b.scene);
  EXPECT_NEAR(powerOf(traced(world, {100000, 1})), 2 * 4 * 1.5 * double{kPi}, 0.03 * 12 * double{kPi});  // both sides
}

TEST(Photons, ASceneWithoutLightSaysSo) {
  SceneBuilder b;
  b.sphere(1, vec3(1), {0, 0, 4});
  World world(b.scene);
  EXPECT_TRUE(traced(world, {1000, 5}).empty());
  EXPECT_EQ(world.log.count("photons-no-light"), 1);
}

// A glowing sheet of 2 x 2 in a large black ball.
SceneBuilder glowingSheet(const ParamList& primvars = {}) {
  SceneBuilder b;
  b.sphere(5, vec3(0), {0, 0, 4});
  Problems problems;
  Param P{"P", Storage::Vertex, ValueType::Point, 1, {-1, -1, 4, 1, -1, 4, 1, 1, 4, -1, 1, 4}, {}, {}};
  ParamList params = primvars;
  params.push_back(P);
  b.add(makePolygons({4}, {0, 1, 2, 3}, params, problems), vec3(0.5f));
  auto glowing = std::make_shared<Attributes>(*b.scene.objects[1].attributes);
  glowing->surface = std::make_shared<ShaderCall>(call("constant"));
  b.scene.objects[1].attributes = glowing;
  return b;
}

TEST(Photons, OfASurfaceThatGlowsCarryWhatItsShaderAddsOnBothSides) {
  World world(glowingSheet().scene);
  const auto photons = traced(world, {20000, 2, 0, false});
  EXPECT_NEAR(powerOf(photons), 2 * 4 * double{kPi} * 0.5, 1e-3 * 4 * double{kPi});
  for (const StoredPhoton& p : photons) ASSERT_EQ(p.depth, 1) << "gather rays see the sheet themselves";
  EXPECT_TRUE(traced(world, {1000, 1}).empty()) << "one bounce is what gather rays see";
  EXPECT_EQ(world.log.count("photons-no-light"), 0);
}

TEST(Photons, OfASurfaceThatGlowsHereAndThereComeFromWhereItIsBright) {
  Param Cs{"Cs", Storage::Vertex, ValueType::Color, 1, {0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0}, {}, {}};
  World world(glowingSheet({Cs}).scene);
  const auto photons = traced(world, {50000, 2, 0, false});
  EXPECT_NEAR(powerOf(photons), 2 * 4 * double{kPi} * 0.5, 0.01 * 4 * double{kPi});  // the mean of u v 2
  double largest = 0;
  for (const StoredPhoton& p : photons) largest = std::max(largest, double{p.power.y});
  EXPECT_LT(largest, 2 * powerOf(photons) / static_cast<double>(photons.size()));
}

TEST(Photons, OfAGlowThatCannotBeSampledAreSaidToBeMissing) {
  SceneBuilder b = glowingSheet();
  b.scene.objects.push_back(b.scene.objects[1]);
  for (size_t i = 1; i < 3; ++i) {
    auto faded = std::make_shared<Attributes>(*b.scene.objects[i].attributes);
    faded->detail = {0, 0.5f};
    b.scene.objects[i].attributes = faded;
  }
  World world(b.scene);
  EXPECT_TRUE(traced(world, {1000, 5}).empty());
  EXPECT_EQ(world.log.count("photons-glow"), 1);
}

/// The integral over a shell around the middle of the ball, of the mean radiance from all sides.
vec3 lightBetween(World& world, const PhotonSettings& settings, float from, float to) {
  vec3 sum(0);
  for (const StoredPhoton& p : traced(world, settings)) {
    const float r = glm::distance(p.P, vec3(0, 0, 4));
    if (p.group < 0 && r >= from && r < to) sum += p.power / (4 * kPi);
  }
  return sum;
}

TEST(PhotonsInMedia, OfAFurnaceBringEachColourItsLight) {
  SceneBuilder b = cloud({0.5f, 2, 4}, vec3(0));
  b.light("environmentlight", {});
  World world(b.scene);
  const float r = 0.8f;
  vec3 light(0);  // one seed alone is off by a hundredth
  for (const uint32_t seed : {0u, 1u, 2u, 3u})
    light += lightBetween(world, {100000, 200, seed}, 0, r) / (4 * 4.0f / 3 * kPi * r * r * r);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light[c], 1, 0.02f) << c;
}

TEST(PhotonsInMedia, AreAbsorbedOnTheirWay) {
  const vec3 absorption(0.5f, 1, 2);
  SceneBuilder b = cloud(vec3(0), absorption);
  b.light("pointlight", {floatParam("intensity", 1), pointParam("from", {0, 0, 4})});
  World world(b.scene);
  const vec3 light = lightBetween(world, {200000, 10}, 0.5f, 0.7f);
  for (int c = 0; c < 3; ++c) {
    const float expected = kPi * (std::exp(-0.5f * absorption[c]) - std::exp(-0.7f * absorption[c])) /
                           absorption[c];  // of a power of 4 pi^2
    EXPECT_NEAR(light[c], expected, 0.015f * expected) << c;
  }
}

TEST(PhotonsInMedia, GoOnAsFarAsTheColoursThatTheyHaveLeftReach) {
  SceneBuilder b = cloud(vec3(0), {1e8f, 0, 1});
  b.light("pointlight", {floatParam("intensity", 1), pointParam("from", {0, 0, 4})});
  World world(b.scene);
  EXPECT_LT(traced(world, {20000, 10}).size(), 3u * 20000);
  const float expected = kPi * (std::exp(-0.5f) - std::exp(-0.7f));
  EXPECT_NEAR(lightBetween(world, {200000, 10}, 0.5f, 0.7f).z, expected, 0.03f * expected);
}

TEST(PhotonIrradiance, ABallThatABorderCutsIsKnownByItsCentroid) {
  EXPECT_NEAR(coveredShareOfBall(0), 1, 1e-3f);
  EXPECT_NEAR(coveredShareOfBall(0.375f), 0.5f, 1e-3f);
  EXPECT_LT(coveredShareOfBall(0.9f), 0.02f);
}

}  // namespace
}  // namespace tomales
