// Tests the photons of lights of every kind, where the power that arrives is known.
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "gi/atlas.h"
#include "gi/photons.h"
#include "gi/point_file.h"
#include "reyes/base/rng.h"
#include "reyes/shader.h"
#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// Returns the attributes of the object that was added last, to be changed.
Attributes& latest(SceneBuilder& b) {
  auto attributes = std::make_shared<Attributes>(*b.scene.objects.back().attributes);
  b.scene.objects[b.scene.objects.size() - 1].attributes = attributes;
  return *attributes;
}

constexpr float kLamp = 1.5f;  ///< Radiance
const vec3 kMiddle(0, 0, 8);

/// A closed surface around kMiddle that shines inwards.
Scene hollowLamp(const vec3& radii, float albedo, float scale = 1) {
  SceneBuilder b;
  b.light("arealight", {floatParam("intensity", kLamp)});
  b.scene.lights[0]->area = true;
  b.sphere(1, vec3(albedo), vec3(0));
  mat4 m(1.0f);
  for (int k = 0; k < 3; ++k) m[k] *= radii[k];
  m[3] = vec4(kMiddle, 1);
  b.scene.objects[0].worldFromObject = Motion::still(m);
  b.scene.cameraFromWorld = Motion::still(glm::mat4(mat3(scale)));
  Attributes& lamp = latest(b);
  lamp.areaLight = 0;
  lamp.insideOut = true;
  return b.scene;
}

TEST(PhotonEmission, PhotonsOfAHollowLampAreNotCaughtBehindIt) {
  for (const vec3 radii : {vec3(2), vec3(2, 2, 3)}) {
    World world(hollowLamp(radii, 0));
    const std::vector<StoredPhoton> photons = traced(world, {20000, 1});
    int outside = 0;
    for (const StoredPhoton& p : photons) outside += dot(p.P - kMiddle, p.N) > 0;
    EXPECT_LT(outside, 60) << radii.z;
    const double sphere = 4 * double{kPi} * double{kPi} * 4 * double{kLamp};
    if (radii.z == 2) {
      EXPECT_NEAR(powerOf(photons), sphere, 0.005 * sphere);
    }
  }
}

TEST(PhotonEmission, AHollowLampLightsItselfByAllBounces) {
  const double once = 4 * double{kPi} * double{kPi} * 4 * double{kLamp};
  World world(hollowLamp(vec3(2), 0.5f));
  EXPECT_NEAR(powerOf(traced(world, {50000, 30})), 2 * once, 0.01 * once);
}

TEST(PhotonEmission, SmallRoomsHaveTheLightOfLargeOnes) {
  for (const float size : {1.0f, 1e-4f, 1e-6f}) {
    SceneBuilder b;
    b.light("pointlight", {floatParam("intensity", size * size), pointParam("from", {0.1f * size, 0, 3 * size})});
    b.sphere(2 * size, vec3(0.5f), {0, 0, 3 * size});
    World world(b.scene);
    const double power = 4 * double{kPi} * double{kPi} * double{size} * double{size};
    EXPECT_NEAR(powerOf(traced(world, {20000, 1})), power, 0.01 * power) << size;
  }
}

struct PhotonFiles : ::testing::Test {
  const fs::path folder = fs::temp_directory_path() / "tomales_photon_files";
  ~PhotonFiles() override { fs::remove_all(folder); }

  /// Returns the power of all photons in the file of a map, in green.
  double powerIn(const Scene& scene, const std::string& map) {
    World world(scene);
    const auto services = world.use({.mode = GiMode::None});
    AtlasSettings settings;
    settings.photons = {100000, 1};
    const MapNames names = mapNames(world.scene, world.shading, settings);
    writePhotons(folder, {world.tools(), names, settings, {}, world.stats, world.log});
    const PointCloud cloud = PointFile(atlasFile(folder, map, ".ptc").string()).readAll();
    double sum = 0;
    for (size_t i = 0; i < cloud.count(); ++i) sum += double{cloud.at(i)[1]};
    return sum;
  }
};

TEST_F(PhotonFiles, HoldThePowerOfTheWorldWhateverTheScaleOfTheCamera) {
  const double power = 4 * double{kPi} * double{kPi} * 4 * double{kLamp};
  for (const float scale : {1.0f, 10.0f, 0.1f})
    EXPECT_NEAR(powerIn(hollowLamp(vec3(2), 0, scale), "scene0"), power, 0.005 * power) << scale;
}

TEST_F(PhotonFiles, OfMediaHoldItToo) {
  const auto fog = [](float scale) {
    Scene scene = hollowLamp(vec3(2), 0, scale);
    auto attributes = std::make_shared<Attributes>(*scene.objects[0].attributes);
    attributes->interior = attributes->exterior = std::make_shared<ShaderCall>(
        call("fog", {{"absorption", Storage::Uniform, ValueType::Color, 1, {1, 1, 1}, {}, {}}}));
    scene.objects[0].attributes = attributes;
    return scene;
  };
  const double once = powerIn(fog(1), "scene.volume");
  EXPECT_GT(once, 1);
  for (const float scale : {10.0f, 0.1f}) EXPECT_NEAR(powerIn(fog(scale), "scene.volume"), once, 0.01 * once) << scale;
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(PhotonFiles, OfAnyNumberOfPartsHaveTheBytesOfOneRun) {
  SceneBuilder b;
  b.light("pointlight", {floatParam("intensity", 4), pointParam("from", {0.5f, 0, 3})});
  b.light("pointlight", {floatParam("intensity", 1), pointParam("from", {-0.5f, 0.2f, 3})});
  b.sphere(2, vec3(0.5f), {0, 0, 3});
  const Scene scene = b.scene;
  AtlasSettings settings;
  settings.photons = {30001, 4};
  World whole(scene);
  const auto wholeServices = whole.use({.mode = GiMode::None});
  const MapNames names = mapNames(whole.scene, whole.shading, settings);
  const PhotonFigures all =
      writePhotons(folder / "whole", {whole.tools(), names, settings, {}, whole.stats, whole.log});
  for (const int count : {1, 3, 40}) {  // of 40 parts some have no photon
    World world(scene);
    const auto services = world.use({.mode = GiMode::None});
    std::vector<fs::path> parts;
    PhotonFigures sum;
    for (int i = 0; i < count; ++i) {
      parts.push_back(folder / std::to_string(i));
      const PhotonFigures figures =
          writePhotonPart(parts.back(), {i, count}, {world.tools(), names, settings, {}, world.stats, world.log});
      sum.emitted += figures.emitted;
      sum.stored += figures.stored;
    }
    EXPECT_EQ(sum.emitted, all.emitted);
    EXPECT_EQ(sum.stored, all.stored);
    joinPhotonParts(parts, folder / "joined", names, settings, world.stats, world.log);
    for (const std::string& map : names.all())
      EXPECT_EQ(contentOf(atlasFile(folder / "joined", map, ".ptc")),
                contentOf(atlasFile(folder / "whole", map, ".ptc")))
          << map << " of " << count;
    AtlasSettings other = settings;
    other.photons.seed = 1;
    EXPECT_THROW(joinPhotonParts(parts, folder / "other", names, other, world.stats, world.log), FileError);
    if (count > 1) {
      std::swap(parts[0], parts[1]);
      EXPECT_THROW(joinPhotonParts(parts, folder / "turned", names, settings, world.stats, world.log), FileError);
    }
  }
}

/// Two sheets at different depths that face the sun, and nothing between.
SceneBuilder sheets() {
  SceneBuilder b;
  b.light("sunlight", {{"sundirection", Storage::Uniform, ValueType::Vector, 1, {0, 0, -1}, {}, {}},
                       {"zenith", Storage::Uniform, ValueType::Vector, 1, {0, 0.6f, -0.8f}, {}, {}},
                       floatParam("sunsize", 1)});
  b.quad({-3, 0, 5}, {-2, 0, 5}, {-2, 1, 5}, {-3, 1, 5}, vec3(0.5f));
  b.quad({3, 0, 8}, {4, 0, 8}, {4, 1, 8}, {3, 1, 8}, vec3(0.5f));
  return b;
}

TEST(PhotonEmission, TheSunSendsPhotonsAtWhatItsWidthReaches) {
  for (const float size : {1.0f, 40.0f}) {
    SceneBuilder b = sheets();
    auto sun = std::make_shared<LightCall>(*b.scene.lights[0]);
    sun->shader.params.back() = floatParam("sunsize", size);
    b.scene.lights[0] = sun;
    World world(b.scene);
    ASSERT_EQ(world.shading.light(0).kind(), LightKind::Distant);
    LightProbe probe;
    for (uint32_t i = 0; i < 4096; ++i) {
      probe.P.emplace_back(0, 0, 5);
      probe.N.emplace_back(0, 0, -1);
      probe.xi.push_back(sobol2(i, 3U));
    }
    world.shading.probe(0, probe);
    double E = 0;  // on what faces the middle
    for (size_t i = 0; i < probe.L.size(); ++i) E -= double{kPi} / 4096 * double{probe.Cl[i].y * probe.L[i].z};
    ASSERT_GT(E, 1);
    EXPECT_NEAR(powerOf(traced(world, {100000, 1})), 2 * E, 0.01 * 2 * E) << size;
  }
}

TEST(PhotonEmission, APenumbraHasTheWidthOfTheSun) {
  SceneBuilder b = sheets();
  auto sun = std::make_shared<LightCall>(*b.scene.lights[0]);
  sun->shader.params.back() = floatParam("sunsize", 40);
  b.scene.lights[0] = sun;
  b.quad({0, -9, 5}, {9, -9, 5}, {9, 9, 5}, {0, 9, 5}, vec3(0.5f));
  b.quad({-9, -9, 8}, {9, -9, 8}, {9, 9, 8}, {-9, 9, 8}, vec3(0.5f));
  World world(b.scene);
  int beyond = 0;  // the edge, as far as half the width of a penumbra
  for (const StoredPhoton& p : traced(world, {100000, 1}))
    beyond += p.P.z > 7.9f && std::abs(p.P.y) < 3 && p.P.x > 0.1f && p.P.x < 0.5f;
  EXPECT_GT(beyond, 40);
}

/// A black room around (0, 0, 8) whose wall at the right has an opening of 0.4 x 0.6, under a sky.
SceneBuilder roomWithAWindow(const std::string& portals, const std::string& shader = "environmentlight") {
  SceneBuilder b;
  ParamList params{floatParam("intensity", 1.5f)};
  if (!portals.empty()) params.push_back({"portals", Storage::Uniform, ValueType::String, 1, {}, {}, {portals}});
  b.light(shader, params);
  const auto at = [](float x, float y, float z) { return vec3(x, y, 8 + z); };
  const vec3 black(0);
  b.quad(at(-1, -1, -1), at(-1, 1, -1), at(-1, 1, 1), at(-1, -1, 1), black);
  for (const float s : {-1.0f, 1.0f}) {
    b.quad(at(-1, s, -1), at(1, s, -1), at(1, s, 1), at(-1, s, 1), black);
    b.quad(at(-1, -1, s), at(1, -1, s), at(1, 1, s), at(-1, 1, s), black);
    b.quad(at(1, s, -1), at(1, s * 0.2f, -1), at(1, s * 0.2f, 1), at(1, s, 1), black);
    b.quad(at(1, -0.2f, s), at(1, 0.2f, s), at(1, 0.2f, s * 0.3f), at(1, -0.2f, s * 0.3f), black);
  }
  mat4 window(1.0f);
  window[0] = vec4(0, 0.4f, 0, 0);
  window[1] = vec4(0, 0, 0.6f, 0);
  window[2] = vec4(1, 0, 0, 0);
  window[3] = vec4(at(1, 0, 0), 1);
  b.scene.worldFromNamed["window"] = window;
  return b;
}

TEST(PhotonEmission, ASkySendsPhotonsThroughItsPortals) {
  const double truth = double{kPi} * 1.5 * 0.4 * 0.6;
  std::map<std::string, double> noise;
  for (const std::string portals : {"", "window"}) {
    World world(roomWithAWindow(portals).scene);
    double power = 0, squares = 0;
    for (const StoredPhoton& p : traced(world, {200000, 1})) {
      const vec3 off = p.P - kMiddle;
      if (dot(off, p.N) > 0) continue;
      power += double{p.power.y};
      squares += double{p.power.y} * double{p.power.y};
    }
    noise[portals] = std::sqrt(squares);
    EXPECT_NEAR(power, truth, (portals.empty() ? 0.15 : 0.01) * truth) << portals;
  }
  EXPECT_LT(noise["window"], 0.1 * noise[""]);
}

rsl::StringParam defaultPortals("portals", "window", "", TM_ROLE_SKY_PORTALS);
void shine(const TmGrid* g) {
  for (int i : rsl::Batch(g)) rsl::set(g->Cl, i, {1.5f, 1.5f, 1.5f});
}
const rsl::Shader windowlight(TM_LIGHT, "windowlight", "", TM_LIGHT_SOLAR | TM_LIGHT_SKY, shine, {&defaultPortals});

TEST(PhotonEmission, PortalsMayBeTheDefaultOfTheSkysShader) {
  const TmShader* const shaders[] = {windowlight};
  const TmShaderLibrary library = rsl::libraryOf(shaders);
  const auto photons = [&](const std::string& portals, const std::string& shader) {
    World world(roomWithAWindow(portals, shader).scene, &library);
    return powerOf(traced(world, {20000, 1}));
  };
  EXPECT_FLOAT_EQ(photons("", "windowlight"), photons("window", "environmentlight"));
}

/// A lamp between two sheets.
SceneBuilder linked(ParamList params = {}) {
  SceneBuilder b;
  params.push_back(pointParam("from", {0, 0, 5}));
  b.light("pointlight", params);
  b.quad({-9, -9, 4}, {9, -9, 4}, {9, 9, 4}, {-9, 9, 4}, vec3(0.5f));
  b.quad({-9, -9, 6}, {9, -9, 6}, {9, 9, 6}, {-9, 9, 6}, vec3(0.5f));
  return b;
}

TEST(PhotonEmission, ALightThatIsOffForAllSendsNone) {
  SceneBuilder b = linked();
  for (size_t i = 0; i < 2; ++i) {
    auto off = std::make_shared<Attributes>(*b.scene.objects[i].attributes);
    off->lights.clear();
    b.scene.objects[i].attributes = off;
  }
  World world(b.scene);
  EXPECT_TRUE(traced(world, {1000, 5}).empty());
}

TEST(PhotonEmission, ALightThatIsOnForSomeLandsOnThoseAloneAndGoesOnFromThere) {
  SceneBuilder b = linked();
  latest(b).lights.clear();
  World world(b.scene);
  int near = 0, far = 0, later = 0;
  for (const StoredPhoton& p : traced(world, {10000, 5})) (p.P.z < 5 ? near : p.depth == 0 ? far : later)++;
  EXPECT_GT(near, 3000);
  EXPECT_EQ(far, 0);
  EXPECT_GT(later, 500);
}

TEST(PhotonEmission, ALightThatIsNotDiffuseSendsNone) {
  World world(linked({floatParam("__nondiffuse", 1)}).scene);
  EXPECT_TRUE(traced(world, {1000, 5}).empty());
}

TEST(PhotonEmission, FarLightsBringWhatNearOnesDo) {
  for (const float distance : {10.0f, 1e3f, 1e5f}) {
    SceneBuilder b;
    b.light("pointlight", {floatParam("intensity", distance * distance), pointParam("from", {0, 0, 5 - distance})});
    b.quad({-1, -1, 5}, {1, -1, 5}, {1, 1, 5}, {-1, 1, 5}, vec3(0));
    World world(b.scene);
    const std::vector<StoredPhoton> photons = traced(world, {20000, 1});
    EXPECT_GT(photons.size(), 10000u) << distance;
    EXPECT_NEAR(powerOf(photons), 4 * double{kPi}, 0.02 * 4 * double{kPi}) << distance;
  }
}

/// A wall that a sheet shades from the light.
SceneBuilder shaded() {
  SceneBuilder b;
  b.light("distantlight", {floatParam("intensity", 1), pointParam("from", {0, 0, 0}), pointParam("to", {0, 0, 1})});
  b.quad({-1, -1, 8}, {1, -1, 8}, {1, 1, 8}, {-1, 1, 8}, vec3(0.5f));
  b.quad({-1, -1, 5}, {1, -1, 5}, {1, 1, 5}, {-1, 1, 5}, vec3(1));
  return b;
}

TEST(PhotonEmission, WhatASheetLetsPassArrivesStraightFromTheLight) {
  SceneBuilder b = shaded();
  latest(b).opacity = vec3(0.2f, 0.5f, 0.8f);
  World world(b.scene);
  vec3 onWall(0), onSheet(0);
  for (const StoredPhoton& p : traced(world, {50000, 1})) {
    EXPECT_TRUE(p.depth == 0 && !p.caustic());
    (p.P.z > 6 ? onWall : onSheet) += p.power / (4 * kPi);
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(onSheet[c], 1, 0.02f) << c;
    EXPECT_NEAR(onWall[c], 0.8f - 0.3f * static_cast<float>(c), 0.02f) << c;
  }
}

TEST(PhotonEmission, ASheetThatIsHalfThereSendsHalfBack) {
  SceneBuilder b;
  b.light("pointlight", {floatParam("intensity", 1), pointParam("from", {0, 0, 5})});
  b.sphere(1, vec3(1), {0, 0, 5});
  latest(b).opacity = vec3(0.5f);
  b.sphere(2, vec3(0), {0, 0, 5});
  World world(b.scene);
  double inner = 0, outer = 0;
  for (const StoredPhoton& p : traced(world, {50000, 200}))
    (glm::distance(p.P, vec3(0, 0, 5)) < 1.5f ? inner : outer) += double{p.power.y};
  // All leaves in the end, and half of what arrives inside goes on inside.
  const double power = 4 * double{kPi} * double{kPi};
  EXPECT_NEAR(outer, power, 0.01 * power);
  EXPECT_NEAR(inner, 2 * power, 0.02 * power);
}

TEST(PhotonEmission, OfAnInvisibleSheetNothingIsStored) {
  SceneBuilder b = shaded();
  latest(b).opacity = vec3(0);
  World world(b.scene);
  const std::vector<StoredPhoton> photons = traced(world, {20000, 1});
  for (const StoredPhoton& p : photons) EXPECT_GT(p.P.z, 7);
  EXPECT_NEAR(powerOf(photons), 4 * double{kPi}, 0.02 * 4 * double{kPi});
}

TEST(PhotonEmission, TransparentObjectsAreNoBounceAndMakeNoCaustic) {
  SceneBuilder b = shaded();
  Attributes& glass = latest(b);
  glass.photon.shadingModel = "transparent";
  glass.color = vec3(1, 0.5f, 0.25f);
  World world(b.scene);
  vec3 onWall(0);
  for (const StoredPhoton& p : traced(world, {50000, 1})) {
    EXPECT_TRUE(p.P.z > 7 && p.depth == 0 && !p.caustic());
    onWall += p.power / (4 * kPi);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(onWall[c], c == 0 ? 1 : c == 1 ? 0.5f : 0.25f, 0.02f) << c;
}

}  // namespace
}  // namespace tomales
