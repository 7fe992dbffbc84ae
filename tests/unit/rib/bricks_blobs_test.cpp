// Requests whose primitive is made of something else: Geometry "brickmap", Points of type "blobby".
#include <filesystem>

#include "gi/brick_file.h"
#include "reyes/density.h"
#include "tests/unit/rib/rib_test_tools.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// One brick over the unit cube, with two voxels: (0,0,0) faces z and holds 1 2 3, (7,7,7) is a volume and holds 4 5 6.
struct BrickMapFile : ::testing::Test {
  const fs::path folder = fs::temp_directory_path() / "tomales_rib_bricks";
  BrickMapFile() {
    fs::create_directories(folder);
    const Brick brick(
        {{0, kBrickVoxels - 1}, {{vec3(0, 0, 1), false}, {vec3(0), false}}, {1, 2, 3, 0.5f, 4, 5, 6, 0.25f}}, 4, 0);
    BrickFileWriter file((folder / "two.bkm").string());
    file.add(brick);
    file.finish({{"irradiance", 3}, {"area", 1}}, {{vec3(0), 1}, {BrickNode{}}, 0}, {});
  }
  ~BrickMapFile() override { fs::remove_all(folder); }
};

TEST_F(BrickMapFile, IsADiskForEachVoxelWithItsChannels) {
  const Reading r("Option \"searchpath\" \"texture\" [\"" + folder.string() + "\"]" +
                  inWorld("Geometry \"brickmap\" \"filename\" [\"two.bkm\"]"));
  EXPECT_EQ(r.codes(), "");
  const Prim& prim = r.object(0).shape();
  ASSERT_EQ(prim.patchCount(), 2u);
  const Bound3 first = prim.bound(0, {0.49f, 0.51f, 0.49f, 0.51f});
  EXPECT_LT(glm::length(first.center() - vec3(1 / 16.0f)), 1e-3f);
  float edge[12];
  const float one = 1, half = 0.5f;
  prim.evaluate(0, 1, &one, &half,
                {edge, edge + 1, edge + 2, edge + 3, edge + 4, edge + 5, edge + 6, edge + 7, edge + 8, edge + 9,
                 edge + 10, edge + 11});
  EXPECT_NEAR(glm::distance(vec3(edge[0], edge[1], edge[2]), vec3(1 / 16.0f)), std::sqrt(3.0f) / 16,
              1e-6f);  // a voxel's half diagonal
  for (const Primvar& var : prim.primvars()) {
    const bool color = var.name == "irradiance" || var.name == "Cs";
    EXPECT_TRUE(!color || var.values == (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_TRUE(var.name != "area" || var.values == (std::vector<float>{0.5f, 0.25f}));
  }
}

TEST_F(BrickMapFile, ThatIsMissingOrNoneIsDroppedByName) {
  const Reading r(
      inWorld("Geometry \"brickmap\" \"filename\" [\"/nowhere.bkm\"]\nGeometry \"brickmap\"\nGeometry \"cube\""));
  EXPECT_EQ(r.log.count("rib-object-dropped"), 3);
  EXPECT_EQ(r.message("rib-object-dropped").where.line, 2);
}

TEST(PointsOfTypeBlobby, AreOneBlobbyAsWideAsThePointsAre) {
  const Reading r(
      inWorld("Points \"P\" [0 0 0 0.7 0 0 9 0 0] \"constantwidth\" [1] \"uniform string type\" [\"blobby\"] \"varying "
              "color Cs\" [1 0 0 0 1 0 0 0 1]\n"
              "Blobby 1 [1001 0] [1 0 0 0 0 1 0 0 0 0 1 0 9 0 0 1] [\"\"]"));
  EXPECT_EQ(r.codes(), "");
  const auto boundOf = [](const Prim& prim) {
    Bound3 bound;
    for (uint32_t patch = 0; patch < prim.patchCount(); ++patch) bound.extend(prim.bound(patch, {}));
    return bound;
  };
  const Bound3 joined = boundOf(r.object(0).shape()), alone = boundOf(r.object(1).shape());
  EXPECT_NEAR(joined.hi.x, alone.hi.x, 0.02f);
  EXPECT_NEAR(joined.hi.x, 9.5f, 0.02f);
  ASSERT_EQ(r.object(0).shape().primvars().size(), 1u);
}

TEST(RepelledBlobby, WithoutItsPictureIsWholeAndSaidToBe) {
  const Reading r(
      inWorld("Blobby 2 [1001 0 1003 0 16 0 2 0 1] [1.5 0 0 0 0 1.5 0 0 0 0 1.5 0 0 0 -.1 1 .4 .01 .3 .08] "
              "[\"/nowhere.zfile\"]\n"
              "Blobby 2 [1001 0 1003 1 16 0 2 0 1] [1.5 0 0 0 0 1.5 0 0 0 0 1.5 0 0 0 -.1 1 .4 .01 .3 .08] "
              "[\"/nowhere.zfile\"]"));
  EXPECT_EQ(r.codes(), "rib-ground@2 rib-object-dropped@3 ");
  EXPECT_EQ(r.scene().objects.size(), 1u);
}

TEST(PointsOfTypeBlobby, MoveAsBlobbiesDo) {
  const Reading r("Shutter 0 1" +
                  inWorld("MotionBegin [0 1] Points \"P\" [0 0 0 1 0 0] \"uniform string type\" [\"blobby\"]\n"
                          "Points \"P\" [0 1 0 1 1 0] \"uniform string type\" [\"blobby\"] MotionEnd"));
  EXPECT_EQ(r.codes(), "");
  // There are keys between the keys, as of a Blobby, at places between.
  EXPECT_EQ(r.object(0).shapeTimes, (std::vector<float>{0, 0.25f, 0.5f, 0.75f, 1}));
  ASSERT_EQ(r.object(0).shapes.size(), 5u);
  for (size_t k = 0; k < 5; ++k) {
    Bound3 bound;
    for (uint32_t patch = 0; patch < r.object(0).shapes[k]->patchCount(); ++patch)
      bound.extend(r.object(0).shapes[k]->bound(patch, {}));
    EXPECT_NEAR(0.5f * (bound.lo.y + bound.hi.y), 0.25f * static_cast<float>(k), 0.02f);
  }
}

TEST(Blobbies, OfOtherLeavesAtAnotherKeyHaveNoKeysBetween) {
  const std::string ball = " [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] [\"\"] ";
  const Reading r("Shutter 0 1" +
                  inWorld("MotionBegin [0 1] Blobby 1 [1001 0]" + ball + "Blobby 1 [1001 0 7 0]" + ball + "MotionEnd"));
  EXPECT_EQ(r.object(0).shapes.size(), 2u);
}

TEST(PointsOfTypeBlobby, OfNoWidthAreNothingAndOfNegativeWidthAnError) {
  const Reading r(
      inWorld("Points \"P\" [0 0 0 1 0 0 2 0 0] \"varying float width\" [1 0 0] \"uniform string type\" [\"blobby\"]\n"
              "Points \"P\" [0 0 0 1 0 0] \"varying float width\" [1 -1] \"uniform string type\" [\"blobby\"]"));
  EXPECT_EQ(r.codes(), "rib-object-dropped@3 ");
  EXPECT_NE(r.message("rib-object-dropped").message.find("width is -1 somewhere"), std::string::npos);
  EXPECT_LT(r.object(0).shape().bound(0, {}).hi.x, 0.6f);
}

TEST(PointsOfTypeBlobby, WithWidthsThatDoNotFitAreDropped) {
  const Reading r(
      inWorld("Points \"P\" [0 0 0 1 0 0] \"varying float width\" [1 2 3] \"uniform string type\" [\"blobby\"]"));
  EXPECT_EQ(r.codes(), "rib-object-dropped@2 ");
}

/// What lies along a ray through the only object of a world.
float columnDensityOf(const Reading& r, const vec3& origin, const vec3& direction) {
  return r.object(0).shape().density()->columnDensity(origin, direction, 0, 100);
}

TEST(Volumes, AreAsDenseEverywhereAsOneNumberSays) {
  for (const auto& [density, expected] : {std::pair("", 1.0f), {"\"uniform float density\" [3]", 3.0f}}) {
    const Reading r(inWorld(std::string("Volume \"box\" [-1 1 0 3 2 2.5] [7 8 9] ") + density));
    EXPECT_TRUE(r.log.entries().empty()) << r.codes();
    EXPECT_NEAR(columnDensityOf(r, {-5, 1, 2.25f}, {1, 0, 0}), 2 * expected, 1e-5f);
    EXPECT_NEAR(columnDensityOf(r, {0.5f, -5, 2.25f}, {0, 1, 0}), 3 * expected, 1e-5f);
    EXPECT_NEAR(columnDensityOf(r, {0.5f, 1, -5}, {0, 0, 1}), 0.5f * expected, 1e-5f);
    EXPECT_EQ(columnDensityOf(r, {1.5f, 1, -5}, {0, 0, 1}), 0);
  }
}

TEST(Volumes, AreLinearBetweenTheNumbersOfALatticeWithXFastest) {
  std::string numbers;
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 3; ++x) numbers += std::to_string(1 + x + 10 * y + 100 * z) + " ";
  for (const char* storage : {"varying", "vertex"}) {
    const Reading r(inWorld("Volume \"box\" [-1 1 0 3 2 2.5] [3 4 2] \"" + std::string(storage) + " float density\" [" +
                            numbers + "]"));
    EXPECT_TRUE(r.log.entries().empty()) << r.codes();
    // At (x, y, z) it is 1 + (x + 1) + 10 y + 100 (z - 2) / 0.5.
    EXPECT_NEAR(columnDensityOf(r, {-5, 1.25f, 2.1f}, {1, 0, 0}), 2 * (1 + 1 + 12.5f + 20), 1e-3f);
    EXPECT_NEAR(columnDensityOf(r, {0.5f, -5, 2.1f}, {0, 1, 0}), 3 * (1 + 1.5f + 15 + 20), 1e-3f);
    EXPECT_NEAR(columnDensityOf(r, {0.5f, 1.25f, -5}, {0, 0, 1}), 0.5f * (1 + 1.5f + 12.5f + 50), 1e-3f);
  }
}

TEST(Volumes, ThatCannotBeAreDroppedWithASentence) {
  for (const auto& [request, why] :
       {std::pair("\"box\" [-1 1 0 3 2 2] [2 2 2]", "its bound has no volume"),
        {"\"box\" [-1 1 3 0 2 3] [2 2 2]", "its bound has no volume"},
        {"\"box\" [1 1 0 3 2 3] [2 2 2]", "its bound has no volume"},
        {"\"box\" [-1 1 0 3 2 3] [2 2]", "it needs three counts of points"},
        {"\"box\" [-1 1 0 3 2 3] [2 2 2] \"varying float density\" [1 2 3 4 5 6 7]", "7 numbers, where 2 x 2 x 2"},
        {"\"box\" [-1 1 0 3 2 3] [1 4 2] \"varying float density\" [1 2 3 4 5 6 7 8]", "at least 2 each way"},
        {"\"box\" [-1 1 0 3 2 3] [4 1 2] \"varying float density\" [1 2 3 4 5 6 7 8]", "at least 2 each way"},
        {"\"box\" [-1 1 0 3 2 3] [4 2 1] \"varying float density\" [1 2 3 4 5 6 7 8]", "at least 2 each way"},
        {"\"cloud\" [-1 1 0 3 2 3] [2 2 2]", "there is no Volume of type \"cloud\""},
        {"\"blobbydso:smoke\" [-1 1 0 3 2 3] [2 2 2]", "there is no plugin \"smoke\""},
        {"\"blobbydso:impl_openvdb\" [-1 1 0 3 2 3] [2 2 2]", "with a file and a grid"}}) {
    const Reading r(inWorld(std::string("Volume ") + request));
    EXPECT_EQ(r.codes(), "rib-object-dropped@2 ") << request;
    EXPECT_NE(r.message("rib-object-dropped").message.find(why), std::string::npos)
        << r.message("rib-object-dropped").message;
  }
}

TEST(Volumes, OfNegativeDensityAreEmptyThere) {
  const Reading r(inWorld("Volume \"box\" [0 1 0 1 0 1] [2 2 2] \"varying float density\" [-1 1 -2 1 0 1 0 1]"));
  ASSERT_EQ(r.log.entries().size(), 1u);
  EXPECT_NE(r.log.entries()[0].message.find("2 of its densities"), std::string::npos) << r.log.entries()[0].message;
  EXPECT_NEAR(columnDensityOf(r, {-5, 0.5f, 0.5f}, {1, 0, 0}), 0.5f, 1e-5f);
}

}  // namespace
}  // namespace tomales
