// What changes the light of a world changes its sum, and nothing else does.
#include "reyes/world_sum.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "reyes/rib.h"

namespace tomales {
namespace {

uint64_t sumOf(const std::string& rib) {
  Log log;
  uint64_t sum = 0;
  RibSettings settings;
  settings.onScene = [&](Scene&& scene) { sum = worldSum(scene); };
  readRibText(rib, "test.rib", settings, log);
  EXPECT_NE(sum, 0u) << rib;
  return sum;
}

const std::string kCamera = "Format 32 32 1\nProjection \"perspective\"\nTranslate 0 0 5\n";
const std::string kLight = "LightSource \"pointlight\" 1 \"intensity\" [3]\n";
const std::string kBall = "Surface \"matte\" \"Kd\" [0.5]\nSphere 1 -1 1 360\n";
std::string world(const std::string& inside) { return "WorldBegin\n" + inside + "WorldEnd\n"; }

TEST(WorldSum, DoesNotDependOnCameraFormatLinesOrOrder) {
  const uint64_t sum = sumOf(kCamera + world(kLight + kBall + "Translate 3 0 0\n" + kBall));
  EXPECT_EQ(sum, sumOf("Format 640 480 1\nRotate 20 1 0 0\nPixelSamples 8 8\n" +
                       world(kLight + kBall + "Translate 3 0 0\n" + kBall)));
  EXPECT_EQ(sum, sumOf(kCamera + world("# a comment\n\n" + kLight + kBall + "Translate 3 0 0\n" + kBall)));
  EXPECT_EQ(sum,
            sumOf(kCamera + world(kLight + "TransformBegin\nTranslate 3 0 0\n" + kBall + "TransformEnd\n" + kBall)));
}

TEST(WorldSum, ChangesWithEverythingThatLightMeets) {
  const uint64_t sum = sumOf(kCamera + world(kLight + kBall));
  EXPECT_NE(sum, sumOf(kCamera + world("LightSource \"pointlight\" 1 \"intensity\" [3.01]\n" + kBall)));
  EXPECT_NE(sum, sumOf(kCamera + world(kLight + "Surface \"matte\" \"Kd\" [0.5]\nSphere 1 -1 1 359\n")));
  EXPECT_NE(sum, sumOf(kCamera + world(kLight + "Surface \"matte\" \"Kd\" [0.51]\nSphere 1 -1 1 360\n")));
  EXPECT_NE(sum, sumOf(kCamera + world(kLight + "Translate 0 0 0.01\n" + kBall)));
  EXPECT_NE(sum, sumOf(kCamera + world(kLight + "Color 1 1 0.9\n" + kBall)));
  EXPECT_NE(sum, sumOf(kCamera + world(kLight + kBall + kBall)));
}

TEST(WorldSum, ObjectsThatPhotonsPassDoNotCount) {
  const std::string unseen = "AttributeBegin\nAttribute \"visibility\" \"int photon\" [0]\n" + kBall + "AttributeEnd\n";
  EXPECT_EQ(sumOf(kCamera + world(kLight + unseen + kBall)), sumOf(kCamera + world(kLight + kBall)));
}

TEST(WorldSum, AreaLightsCountThoughPhotonsPassThem) {
  const auto lamp = [](const char* size) {
    return std::string(
               "AttributeBegin\nAreaLightSource \"arealight\" 2\nAttribute \"visibility\" \"int photon\" "
               "[0]\nSphere ") +
           size + "\nAttributeEnd\n";
  };
  EXPECT_NE(sumOf(kCamera + world(lamp("1 -1 1 360") + kBall)), sumOf(kCamera + world(lamp("2 -2 2 360") + kBall)));
}

TEST(WorldSum, ChangesWithTheOperationsOfSolids) {
  const auto solid = [](const std::string& operation) {
    const std::string part = "SolidBegin \"primitive\"\n" + kBall + "SolidEnd\n";
    return sumOf(kCamera + world(kLight + "SolidBegin \"" + operation + "\"\n" + part + "Translate 1 0 0\n" + part +
                                 "SolidEnd\n"));
  };
  EXPECT_NE(solid("union"), solid("difference"));
  EXPECT_NE(solid("union"), solid("intersection"));
  EXPECT_EQ(solid("union"), solid("union"));
}

TEST(WorldSum, ChangesWithTheFilesThatShadersName) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "tomales_world.tex";
  const std::string rib = kCamera + world(kLight + "Surface \"paintedplastic\" \"texturename\" [\"" + file.string() +
                                          "\"]\nSphere 1 -1 1 360\n");
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  const uint64_t none = sumOf(rib);
  write("a");
  const uint64_t first = sumOf(rib);
  write("ab");
  EXPECT_NE(first, none);
  EXPECT_NE(sumOf(rib), first);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace tomales
