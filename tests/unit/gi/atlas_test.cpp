// The maps that photons become, in scenes of which the light at every point is known.
#include "gi/atlas.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "gi/point_file.h"
#include "reyes/base/rng.h"
#include "reyes/world_sum.h"
#include "tests/unit/gi/photon_scenes.h"

namespace tomales {
namespace {

using namespace test;
namespace fs = std::filesystem;

struct Atlas : ::testing::Test {
  const fs::path folder = fs::temp_directory_path() / "tomales_atlas_test";
  ~Atlas() override { fs::remove_all(folder); }
};

std::string contentsOf(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

/// Writes an atlas and returns the mean radiance in the medium of a scene, averaged over places at this distance from
/// the middle of the ball.
vec3 meanRadianceAt(const fs::path& folder, World& world, const PhotonSettings& photons, float distance) {
  AtlasSettings settings;
  settings.photons = photons;
  const auto services = world.use({.mode = GiMode::None});
  const MapNames names = mapNames(world.scene, world.shading, settings);
  EXPECT_EQ(names.volume, "scene.volume");
  writeAtlas(folder, {world.tools(), names, settings, {}, world.stats, world.log});
  BrickCache cache(1 << 24);
  const BrickMap fluence(atlasFile(folder, names.volume, ".bkm").string(), cache);
  const mat4 worldFromCurrent = glm::inverse(world.scene.cameraFromWorldAtOpen());
  constexpr uint32_t kPlaces = 400;
  vec3 sum(0);
  for (uint32_t i = 0; i < kPlaces; ++i) {
    const vec3 up = cosineHemisphere(sobol2(i, 5U));  // both halves are alike
    vec3 here(0);
    EXPECT_TRUE(fluence.lookup(transformPoint(worldFromCurrent, vec3(0, 0, 4) + distance * (i % 2 ? up : -up)), vec3(0),
                               0.02f, &here.x));
    sum += here / static_cast<float>(kPlaces);
  }
  return sum / (4 * kPi);
}

/// The light that the atlas gives to points on the inside of the sphere.
std::vector<vec3> gatheredInside(const fs::path& folder, float tessellation, bool storesDirect = true) {
  World world(insideOfASphere("matte", tessellation));
  const auto services = world.use({.mode = GiMode::Atlas, .storesDirect = storesDirect});
  AtlasSettings settings;
  settings.photons = {200000, 30, 0, storesDirect};
  const MapNames names = mapNames(world.scene, world.shading, settings);
  writeAtlas(folder, {world.tools(), names, settings, {}, world.stats, world.log});
  services->setAtlas(std::make_unique<IrradianceAtlas>(folder, world.scene, names, 1 << 20, world.log));
  ShadePoints points(0, 0);
  for (uint32_t i = 0; i < 6; ++i) {
    const vec3 d = glm::normalize(vec3(static_cast<float>(i) - 2.5f, 0.5f, 1));
    const int k = points.add(i + 1);
    points.set3(kPx, k, vec3(0, 0, 0.5f) + kSphereRadius * d);
    points.set3(kNx, k, d);
    points.set3(kNgx, k, d);
    points.set3(kIx, k, d);
  }
  IndirectQuery query;
  query.samples = 1000;
  return indirectAt(*services, points, query);
}

TEST_F(Atlas, GivesTheIntegratingSphereItsLight) {
  // What the walls receive, all bounces, times their albedo.
  const float expected = kSphereAlbedo * kSphereIntensity / (kSphereRadius * kSphereRadius) / (1 - kSphereAlbedo);
  // Photons lie on polygons, and face as those do: smooth normals would lean over them, and photons of the
  // same polygon look farther off than they are.
  for (const float tessellation : {1.0f, 2.0f})
    for (const vec3& E : gatheredInside(folder / std::to_string(tessellation), tessellation))
      EXPECT_NEAR(E.x, expected, 0.03f * expected) << tessellation;
}

TEST_F(Atlas, GivesTheSameWhereRaysSampleDirectLight) {
  const float expected = kSphereAlbedo * kSphereIntensity / (kSphereRadius * kSphereRadius) / (1 - kSphereAlbedo);
  for (const vec3& E : gatheredInside(folder, 2, false)) EXPECT_NEAR(E.x, expected, 0.03f * expected);
  EXPECT_FALSE(holdsDirect(folder));
}

/// Writes an atlas into `folder`. Returns the names of the stages that had work to do.
std::string stagesOf(const fs::path& folder, const AtlasSettings& settings, float wall, int64_t* kept = nullptr) {
  // Two closed rooms, so that what happens in one changes nothing in the other.
  SceneBuilder b;
  for (const float x : {0.0f, 10.0f}) {
    b.light("pointlight", {floatParam("intensity", kSphereIntensity), pointParam("from", {x + 0.3f, 0, 0.5f})});
    b.sphere(kSphereRadius, vec3(x > 0 ? wall : kSphereAlbedo), {x, 0, 0.5f});
    auto named = std::make_shared<Attributes>(*b.scene.objects.back().attributes);
    named->photon.globalMap = x > 0 ? "right" : "left";
    b.scene.objects[b.scene.objects.size() - 1].attributes = named;
  }
  World world(b.scene);
  const auto services = world.use({.mode = GiMode::None});
  AtlasSettings all = settings;
  all.world = worldSum(world.scene);
  const MapNames names = mapNames(world.scene, world.shading, all);
  writeAtlas(folder, {world.tools(), names, all, {}, world.stats, world.log});
  if (kept) *kept = world.stats.photons.groupsKept;
  std::string out;
  for (const auto& [name, figures] : world.stats.stages()) out += name + " ";
  return out;
}

TEST_F(Atlas, WhatHasNotChangedIsNotMadeAgain) {
  AtlasSettings settings;
  settings.photons = {20000, 10};
  EXPECT_EQ(stagesOf(folder, settings, 0.5f), "brickmake irradiance photons ");
  EXPECT_EQ(stagesOf(folder, settings, 0.5f), "");
  settings.bricks.maxError = 0.1f;
  EXPECT_EQ(stagesOf(folder, settings, 0.5f), "brickmake ");
  settings.irradiance.nearest = 30;
  EXPECT_EQ(stagesOf(folder, settings, 0.5f), "brickmake irradiance ");
  settings.photons.seed = 1;
  EXPECT_EQ(stagesOf(folder, settings, 0.5f), "brickmake irradiance photons ");
  fs::remove(folder / "irradiance" / "left.ptc");
  EXPECT_EQ(stagesOf(folder, settings, 0.5f),
            "irradiance ");  // and gives the same points, so that the bricks stay
}

TEST_F(Atlas, GroupsThatTheSamePhotonsReachKeepTheirMaps) {
  AtlasSettings settings;
  settings.photons = {20000, 10};
  int64_t kept = 0;
  stagesOf(folder, settings, 0.5f, &kept);
  EXPECT_EQ(kept, 0);
  EXPECT_EQ(stagesOf(folder, settings, 0.6f, &kept), "brickmake irradiance photons ");
  EXPECT_EQ(kept, 1);
  EXPECT_EQ(stagesOf(folder, settings, 0.6f, &kept), "");
  EXPECT_EQ(kept, 2);
}

TEST_F(Atlas, MapsWithoutTheirPhotonsAreUsedAndKnownForStrangers) {
  AtlasSettings settings;
  settings.photons = {20000, 10};
  stagesOf(folder, settings, 0.5f);
  EXPECT_FALSE(isMadeByHand(folder));
  fs::remove_all(folder / "photons");
  EXPECT_TRUE(isMadeByHand(folder));
  EXPECT_TRUE(holdsDirect(folder));
  SceneBuilder b;
  World world(b.scene);
  const IrradianceAtlas atlas(folder, world.scene, {{"left", "right"}, {}, {}, {0, 0}}, 1 << 20, world.log);
  EXPECT_TRUE(atlas.mapOfOtherWorld(1).has_value());
  EXPECT_FALSE(atlas.mapOfOtherWorld(0).has_value());
}

/// A mirror of 2 x 2 throws the light of a distant lamp onto a wall of two surfaces, which have one caustic map.
struct MirroredLight {
  static Scene scene() {
    SceneBuilder b;
    b.light("distantlight", {floatParam("intensity", 2), pointParam("from", {0, 0, 0}), pointParam("to", {1, -1, 0})});
    b.quad({-1, -1, 2}, {1, -1, 2}, {1, -1, 4}, {-1, -1, 4}, vec3(1));
    b.quad({4, -6, -6}, {4, 10, -6}, {4, 10, 3}, {4, -6, 3}, vec3(0.5f));
    b.quad({4, -6, 3}, {4, 10, 3}, {4, 10, 12}, {4, -6, 12}, vec3(0.4f));
    for (size_t i = 0; i < b.scene.objects.size(); ++i) {
      auto attributes = std::make_shared<Attributes>(*b.scene.objects[i].attributes);
      (i == 0 ? attributes->photon.shadingModel : attributes->photon.causticMap) = i == 0 ? "chrome" : "wall";
      b.scene.objects[i].attributes = attributes;
    }
    return b.scene;
  }
  explicit MirroredLight(const fs::path& in) : folder(in) {
    AtlasSettings settings;
    settings.photons = {500000, 6};
    names = mapNames(world.scene, world.shading, settings);
    writeAtlas(folder, {world.tools(), names, settings, {}, world.stats, world.log});
  }
  IrradianceAtlas opened() { return {folder, world.scene, names, 1 << 20, world.log}; }
  /// Expects the light of the lamp where the mirror throws it, and none above.
  static void expectCaustic(const IrradianceAtlas& atlas, float tolerance, const std::string& how) {
    const float expected = 2 * std::sqrt(0.5f);  // E/pi of the light, at 45 degrees
    for (const auto& [surface, z] : {std::pair(1, 2.5f), {2, 3.5f}}) {
      EXPECT_NEAR(atlas.causticOverPi(surface, {4, 3, z}, {-1, 0, 0}, 0.1f).y, expected, tolerance * expected) << how;
      EXPECT_LT(atlas.causticOverPi(surface, {4, 6, z}, {-1, 0, 0}, 0.1f).y, 0.01f) << how;
    }
  }

  const fs::path folder;
  World world{scene()};
  const std::unique_ptr<GiServices> services = world.use({.mode = GiMode::None});
  MapNames names;
};

TEST_F(Atlas, CausticsHaveMapsOfTheirOwn) {
  MirroredLight mirrored(folder);
  EXPECT_EQ(mirrored.names.caustic, (std::vector<std::string>{"", "wall.caustic", "wall.caustic"}));
  const IrradianceAtlas atlas = mirrored.opened();
  MirroredLight::expectCaustic(atlas, 0.05f, "photons");
  bool acrossWalls = true;
  const float expected = 2 * std::sqrt(0.5f);
  EXPECT_NEAR(atlas.irradianceOverPi(1, {4, 6, 2.5f}, {-1, 0, 0}, 0.1f, acrossWalls).y, expected, 0.1f * expected);
  EXPECT_FALSE(acrossWalls);
  EXPECT_EQ(mirrored.world.log.worst(), Severity::Info);
}

TEST_F(Atlas, CausticsComeFromTheBrickMapWherePhotonsAreDamagedAndItIsSaidOnce) {
  MirroredLight mirrored(folder);
  const fs::path photons = folder / "photons" / "wall.caustic.ptc";
  const std::string whole = contentsOf(photons);
  ASSERT_GT(whole.size(), 10000u);
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;
  int messages = 0;
  for (const auto& [how, contents] : {std::pair<std::string, std::string>("a bit of a photon", flipped),
                                      {"half of the file", whole.substr(0, whole.size() / 2)},
                                      {"an empty file", ""},
                                      {"another kind of file", std::string(5000, 'x')}}) {
    std::ofstream(photons, std::ios::binary) << contents;
    MirroredLight::expectCaustic(mirrored.opened(), 0.1f, how);
    EXPECT_EQ(mirrored.world.log.count("atlas-damaged"), ++messages) << how;
  }
  EXPECT_EQ(mirrored.world.log.worst(), Severity::Missing);
  fs::remove(photons);
  MirroredLight::expectCaustic(mirrored.opened(), 0.1f, "no photons");
  EXPECT_EQ(mirrored.world.log.count("atlas-damaged"), messages) << "maps may come without their photons";
}

TEST_F(Atlas, WithoutPhotonsAndBricksACausticIsBlackAndNamed) {
  MirroredLight mirrored(folder);
  fs::remove(folder / "photons" / "wall.caustic.ptc");
  fs::remove(atlasFile(folder, "wall.caustic", ".bkm"));
  const IrradianceAtlas atlas = mirrored.opened();
  EXPECT_EQ(atlas.causticOverPi(1, {4, 3, 2.5f}, {-1, 0, 0}, 0.1f), vec3(0));
  EXPECT_EQ(mirrored.world.log.count("atlas-no-map"), 1);
}

TEST_F(Atlas, OfAFurnaceHasTheSameLightEverywhereInItsMedium) {
  SceneBuilder b = cloud(vec3(1), vec3(0));
  b.light("environmentlight", {});
  World world(b.scene);
  for (const float distance : {0.3f, 0.6f, 0.8f})
    EXPECT_NEAR(meanRadianceAt(folder, world, {600000, 100}, distance).y, 1, 0.02f) << distance;
}

TEST_F(Atlas, AMissingMapIsBlackAndNamed) {
  World world(insideOfASphere());
  const IrradianceAtlas atlas(folder, world.scene, mapNames(world.scene, world.shading, {}), 1 << 20, world.log);
  bool acrossWalls = true;
  EXPECT_EQ(atlas.irradianceOverPi(0, {0, 0, 2.5f}, {0, 0, -1}, 0.1f, acrossWalls), vec3(0));
  EXPECT_FALSE(acrossWalls);
  EXPECT_EQ(world.log.count("atlas-no-map"), 1);
}

TEST_F(Atlas, GroupsShareAFileAsTheyAreNamedAndBySize) {
  SceneBuilder b;
  b.sphere(1, vec3(1), {0, 0, 4});
  b.sphere(1, vec3(0.9f), {3, 0, 4});
  b.sphere(1, vec3(0.8f), {6, 0, 4});
  auto named = std::make_shared<Attributes>(*b.scene.objects[2].attributes);
  named->photon.globalMap = "car";
  b.scene.objects[2].attributes = named;
  const World world(b.scene);
  EXPECT_EQ(mapNames(world.scene, world.shading, {}).global, (std::vector<std::string>{"scene0", "scene0", "car"}));
  AtlasSettings small;
  small.mostPhotonBytes = 30 << 20;  // less than half of what a million photons take
  EXPECT_EQ(mapNames(world.scene, world.shading, small).global, (std::vector<std::string>{"scene0", "scene1", "car"}));
}

}  // namespace
}  // namespace tomales
