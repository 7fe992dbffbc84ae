// Shadow maps, flat and deep, against what their texels hold.
#include "reyes/shade/shadow_map.h"

#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "reyes/pictures.h"
#include "tests/unit/shade/written_picture.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

constexpr int kWidth = 8, kHeight = 4;
/// The camera's space is the world's. The second one looks through a window of -1..1 at depth 1.
const mat4 kParallel(1.0f), kPerspective(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 1), vec4(0));

/// Returns where the middle of a texel lies in -1..1, y up.
vec2 screen(int x, int y) {
  return {-1 + 2 * (static_cast<float>(x) + 0.5f) / kWidth, 1 - 2 * (static_cast<float>(y) + 0.5f) / kHeight};
}

template <class Depth>
std::unique_ptr<const ShadowMap> flatMap(const mat4& ndcFromWorld, const Depth& depth) {
  const std::string path = writePicture(test::temporary("tomales_flat_map.exr"), kWidth, kHeight, "Z",
                                        [&](int x, int y) { return std::array{depth(x, y)}; },
                                        {{"worldToCamera", mat4(1)}, {"worldToScreen", ndcFromWorld}});
  std::string error;
  auto map = ShadowMap::read(path, error);
  EXPECT_NE(map, nullptr) << error;
  return map;
}

ShadowReceiver at(const vec3& P, const vec3& N = vec3(0, 0, -1)) { return {P, N, vec3(0), vec3(0)}; }

float shadowOf(const ShadowMap& map, const ShadowReceiver& receiver, float bias = 0, int samples = 64) {
  return map.shadow(receiver, {.bias = bias, .samples = samples}).x;
}

TEST(ShadowMap, EachTexelHidesWhatIsBeyondItsDepth) {
  const auto depth = [](int x, int y) { return 1.0f + static_cast<float>(x + 10 * y); };
  const auto map = flatMap(kParallel, depth);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(shadowOf(*map, at({screen(x, y), depth(x, y) + 0.01f})), 1) << x << ' ' << y;
      EXPECT_EQ(shadowOf(*map, at({screen(x, y), depth(x, y)})), 0) << x << ' ' << y;
    }
}

TEST(ShadowMap, BeyondItsBordersThereIsLight) {
  const auto map = flatMap(kParallel, [](int, int) { return 1.0f; });
  for (const vec2& border : {vec2(1, 0), vec2(-1, 0), vec2(0, 1), vec2(0, -1)}) {
    EXPECT_NEAR(shadowOf(*map, at({border, 2})), 0.5f, 0.02f) << "half of its square is beyond the map";
    EXPECT_EQ(shadowOf(*map, at({1.001f * border, 2})), 0);
    EXPECT_EQ(shadowOf(*map, at({0.5f * border, 2})), 1);
  }
}

TEST(ShadowMap, BehindItsCameraThereIsLight) {
  const auto map = flatMap(kParallel, [](int, int) { return -9.0f; });
  for (const float z : {-1.0f, 0.0f, 0.01f}) EXPECT_EQ(shadowOf(*map, at({0.1f, 0.1f, z})), z > 0);
  const auto window = flatMap(kPerspective, [](int, int) { return -9.0f; });
  EXPECT_EQ(shadowOf(*window, at({0, 0, -1})), 0);
  EXPECT_EQ(shadowOf(*window, at({0, 0, 0})), 0);
  EXPECT_EQ(shadowOf(*window, at({0, 0, 1})), 1);
}

/// The plane z = 5 + slope . (x, y), met along a texel's ray.
float depthOfPlane(bool perspective, const vec2& slope, const vec2& xy) {
  return perspective ? 5 / (1 - dot(slope, xy)) : 5 + dot(slope, xy);
}

TEST(ShadowMap, APlaneIsFollowedSoThatItHidesNothingOfItself) {
  const vec2 slope(0.5f, -0.3f);
  const vec3 normal = glm::normalize(vec3(slope, -1));
  for (const bool perspective : {false, true})
    for (const bool hidden : {false, true}) {
      const auto map = flatMap(perspective ? kPerspective : kParallel, [&](int x, int y) {
        return depthOfPlane(perspective, slope, screen(x, y)) + (hidden ? -1e-3f : 1e-3f);
      });
      for (const vec2& xy : {vec2(0), vec2(0.3f, 0.2f), vec2(-0.4f, 0.1f)}) {
        const float z = depthOfPlane(perspective, slope, xy), size = perspective ? z : 1;
        ShadowReceiver wide = at({size * xy, z}, normal);
        wide.edgeU = 0.5f * size * vec3(1, 0, slope.x);
        wide.edgeV = 0.5f * size * vec3(0, 1, slope.y);
        EXPECT_EQ(shadowOf(*map, wide), hidden) << perspective << ' ' << xy.x;
      }
    }
}

// The left half is hidden, and what is looked up reaches over the middle.
TEST(ShadowMap, ALookupCoversTheMicropolygonAndItsBlur) {
  const auto left = flatMap(kParallel, [](int x, int) { return x < kWidth / 2 ? 1.0f : 9.0f; });
  const auto top = flatMap(kParallel, [](int, int y) { return y < kHeight / 2 ? 1.0f : 9.0f; });
  ShadowReceiver wide = at({-0.125f, 0.25f, 5});  // half a texel from the middle
  EXPECT_EQ(shadowOf(*left, wide), 1);
  EXPECT_EQ(shadowOf(*top, wide), 1);
  EXPECT_NEAR(left->shadow(wide, {.bias = 0, .blur = 0.25f, .samples = 256}).x, 2.0f / 3, 0.02f) << "3 texels wide";
  EXPECT_NEAR(top->shadow(wide, {.bias = 0, .blur = 0.25f, .samples = 256}).x, 0.75f, 0.02f) << "2 texels wide";
  wide.edgeU = {0.5f, 0, 0};  // 2 texels, and as many of the other axis below
  wide.edgeV = {0, 1, 0};
  EXPECT_NEAR(left->shadow(wide, {.bias = 0, .samples = 256}).x, 2.0f / 3, 0.02f);
  EXPECT_NEAR(top->shadow(wide, {.bias = 0, .samples = 256}).x, 2.0f / 3, 0.02f);
  EXPECT_NEAR(left->shadow(wide, {.bias = 0, .width = 0.5f, .samples = 256}).x, 0.75f, 0.02f);
  EXPECT_EQ(left->shadow(wide, {.bias = 0, .width = 0, .samples = 256}).x, 1);
}

// Where a plane is seen from its edge, its depth is unknown.
TEST(ShadowMap, APlaneIsFollowedByNoMoreThanEightTexelsATexel) {
  const vec3 place(0.25f, 0.25f, 20), steep = glm::normalize(vec3(1, 0, -1e-4f));
  const float reach = 8 * 0.5f * (1 + 0.5f * std::sqrt(2.0f));
  for (const float side : {-1.0f, 1.0f}) {
    const auto before = flatMap(kParallel, [&](int, int) { return place.z + side * reach - 0.01f; }),
               behind = flatMap(kParallel, [&](int, int) { return place.z + side * reach + 0.01f; });
    EXPECT_NEAR(shadowOf(*before, at(place, steep)), side > 0 ? 0.5f : 1, 0.02f);
    EXPECT_NEAR(shadowOf(*behind, at(place, steep)), side > 0 ? 0 : 0.5f, 0.02f);
  }
}

TEST(ShadowMap, TheBiasOfItsOwnIsThatOfATexelAndAHalfOfThePlanesSlope) {
  const vec2 xy = screen(5, 1);
  const float texel = 0.5f, z = 5;  // the longer side of a texel
  for (const vec2& slope : {vec2(0), vec2(0.5f, 0), vec2(0, 0.5f), vec2(-0.5f, 0.5f)}) {
    const vec2 halfTexel(1.0f / kWidth, 1.0f / kHeight);
    const float bias = 1.5f * dot(glm::abs(slope), halfTexel) + 0.05f * texel + 1e-5f * z;
    const vec3 normal = glm::normalize(vec3(slope, -1));
    const auto behind = flatMap(kParallel, [&](int, int) { return z - bias + 2e-5f; }),
               before = flatMap(kParallel, [&](int, int) { return z - bias - 2e-5f; });
    EXPECT_EQ(shadowOf(*behind, at({xy, z}, normal), -1), 0) << slope.x << ' ' << slope.y;
    EXPECT_EQ(shadowOf(*before, at({xy, z}, normal), -1), 1) << slope.x << ' ' << slope.y;
  }
  const auto window = flatMap(kPerspective, [&](int, int) { return 4 - (0.05f * 4 * 0.5f + 4e-5f) - 2e-5f; });
  EXPECT_EQ(shadowOf(*window, at({4 * xy.x, 4 * xy.y, 4}), -1), 1) << "a texel is as large as it is far";
  EXPECT_EQ(shadowOf(*window, at({4 * xy.x, 4 * xy.y, 3.9999f}), -1), 0);
}

/// Writes pixels that all hold these samples, which have a value for each channel. The picture is a part of the frame,
/// from its third column and second row on.
std::string deepPicture(const std::vector<std::string>& channels, std::vector<std::vector<float>> samples) {
  const Imath::Box2i frame({0, 0}, {kWidth - 1, kHeight - 1}), window({2, 1}, {kWidth - 2, kHeight - 2});
  Imf::Header header(frame, window);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.insert("worldToCamera", Imf::M44fAttribute(Imath::M44f()));
  header.insert("worldToScreen", Imf::M44fAttribute(Imath::M44f()));
  header.insert(kSampleRegion, Imf::V2fAttribute({3, 2}));
  constexpr size_t kPixels = kWidth * kHeight;
  std::vector<unsigned> counts(kPixels, static_cast<unsigned>(samples.size()));
  std::vector<std::vector<float>> columns;
  for (size_t c = 0; c < channels.size(); ++c) {
    columns.emplace_back();
    for (const std::vector<float>& sample : samples) columns.back().push_back(sample[c]);
  }
  std::vector<std::vector<float*>> pointers;
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), sizeof(unsigned), sizeof(unsigned) * kWidth));
  for (size_t c = 0; c < channels.size(); ++c) {
    header.channels().insert(channels[c], Imf::Channel(Imf::FLOAT));
    pointers.emplace_back(kPixels, columns[c].data());
    buffer.insert(channels[c], Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers[c].data()), sizeof(float*),
                                              sizeof(float*) * kWidth, sizeof(float)));
  }
  const std::string path = test::temporary("tomales_deep_map.exr");
  Imf::DeepScanLineOutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(window.max.y - window.min.y + 1);
  return path;
}

std::unique_ptr<const ShadowMap> readMap(const std::string& path) {
  std::string error;
  auto map = ShadowMap::read(path, error);
  EXPECT_NE(map, nullptr) << error;
  return map;
}

TEST(ShadowMap, ADeepOneDimsLightLayerByLayer) {
  const auto map = readMap(deepPicture({"A", "Z", "ZBack"}, {{0.5f, 2, 4}, {0.5f, 6, 6}}));
  const std::pair<float, float> expected[] = {{1.9f, 0}, {2, 0},        {3, 0.25f}, {3.5f, 0.375f}, {4, 0.5f},
                                              {5, 0.5f}, {5.99f, 0.5f}, {6, 0.75f}, {9, 0.75f}};
  for (const auto& [z, blocked] : expected) EXPECT_NEAR(shadowOf(*map, at({screen(4, 1), z})), blocked, 1e-6f) << z;
}

TEST(ShadowMap, ADeepOneOfColoursDimsEachByItsOwnOpacity) {
  const auto map = readMap(deepPicture({"A", "AB", "AG", "AR", "Z"}, {{1, 0.75f, 0.5f, 0.25f, 2}, {1, 0, 0.5f, 1, 3}}));
  const auto shadow = [&](float z) { return map->shadow(at({screen(4, 1), z}), {.bias = 0}); };
  EXPECT_EQ(shadow(2.5f), vec3(0.25f, 0.5f, 0.75f));
  EXPECT_EQ(shadow(3.5f), vec3(1, 0.75f, 0.75f));
}

TEST(ShadowMap, APartOfAFrameShadowsItsPartAlone) {
  const auto map = readMap(deepPicture({"A", "Z"}, {{1, 2}}));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      EXPECT_EQ(shadowOf(*map, at({screen(x, y), 3})), x >= 2 && x <= kWidth - 2 && y >= 1 && y <= kHeight - 2)
          << x << ' ' << y;
}

TEST(ShadowMap, TheBiasOfADeepOneAllowsForTheRegionOfItsSamples) {
  const auto map = readMap(deepPicture({"A", "Z"}, {{1, 2}}));
  for (const vec2& slope : {vec2(0.5f, 0), vec2(0, 0.5f)}) {
    const vec3 normal = glm::normalize(vec3(slope, -1));
    const float bias = (slope.x > 0 ? 3.5f / kWidth : 2.5f / kHeight) * 0.5f + 0.05f * 0.5f + 2e-5f;
    EXPECT_EQ(shadowOf(*map, at({screen(4, 1), 2 + bias - 1e-4f}, normal), -1), 0) << slope.x;
    EXPECT_EQ(shadowOf(*map, at({screen(4, 1), 2 + bias + 1e-4f}, normal), -1), 1) << slope.x;
  }
}

TEST(ShadowMap, APictureWithoutDepthOrItsCameraIsNone) {
  const auto refused = [](const std::string& channels, const std::map<std::string, mat4>& matrices) {
    std::string error;
    const std::string path = writePicture(
        test::temporary("tomales_no_map.exr"), 2, 2, channels, [](int, int) { return std::array{1.0f}; }, matrices);
    return ShadowMap::read(path, error) == nullptr && error.find("no shadow map") != std::string::npos;
  };
  EXPECT_TRUE(refused("Z", {{"worldToCamera", mat4(1)}}));
  EXPECT_TRUE(refused("Z", {{"worldToScreen", mat4(1)}}));
  EXPECT_TRUE(refused("Y", {{"worldToCamera", mat4(1)}, {"worldToScreen", mat4(1)}}));
}

TEST(ShadowMap, AFileThatEndsEarlyIsNoneAndSaysWhy) {
  const std::string path =
      writePicture(test::temporary("tomales_short_map.exr"), 64, 64, "Z",
                   [](int x, int y) { return std::array{static_cast<float>((x * 31 + y * 17) % 101)}; },
                   {{"worldToCamera", mat4(1)}, {"worldToScreen", mat4(1)}});
  std::string error;
  EXPECT_NE(ShadowMap::read(path, error), nullptr);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_EQ(ShadowMap::read(path, error), nullptr);
  EXPECT_NE(error, "");
}

TEST(ShadowMaps, AreReadOnceAndOneOfItsNameElsewhereIsTakenAndTold) {
  flatMap(kParallel, [](int, int) { return 1.0f; });
  Log log(Log::Verbosity::Quiet);
  const ShadowMaps maps(std::filesystem::temp_directory_path().string(), log);
  const ShadowMap* there = maps.find("tomales_flat_map.exr", {}, "sun");
  EXPECT_NE(there, nullptr);
  EXPECT_EQ(maps.find("tomales_flat_map.exr", {}, "sun"), there);
  EXPECT_EQ(maps.find("", {}, "sun"), nullptr);
  EXPECT_TRUE(log.entries().empty());
  EXPECT_NE(maps.find("nowhere/tomales_flat_map.exr", {}, "sun"), nullptr);
  EXPECT_EQ(log.count("texture-elsewhere"), 1);
  EXPECT_EQ(maps.find("tomales_absent_map.exr", {}, "sun"), nullptr);
  ASSERT_EQ(log.count("shadow-map"), 1);
  EXPECT_NE(log.entries().back().message.find("not found in"), std::string::npos);
  EXPECT_EQ(maps.find(test::temporary("."), {}, "sun"), nullptr);
  EXPECT_EQ(log.entries().back().message.find("not found in"), std::string::npos) << "it is there, and no picture";
}

}  // namespace
}  // namespace tomales
