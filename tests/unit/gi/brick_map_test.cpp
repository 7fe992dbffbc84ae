// Brick maps of surfaces whose data are known at every point.
#include "gi/brick_map.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

struct BrickMaps : ::testing::Test {
  const fs::path folder = fs::temp_directory_path() / "tomales_bricks";
  const std::string path = (folder / "a.bkm").string();
  BrickCache cache;
  BrickMaps() { fs::create_directories(folder); }
  ~BrickMaps() override { fs::remove_all(folder); }
};

/// Points of a unit square at height z facing up or down, with one float of data.
template <class Value>
void addSquare(PointCloud& cloud, int side, float z, float up, const Value& value) {
  if (cloud.channels.empty()) cloud.channels = {{"value", 1}};
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const float x = (static_cast<float>(i) + 0.5f) / static_cast<float>(side),
                  y = (static_cast<float>(j) + 0.5f) / static_cast<float>(side);
      const float v = value(x, y);
      cloud.add({x, y, z}, {0, 0, up}, 0.8f / static_cast<float>(side), &v);
    }
}

float lookedUp(const BrickMap& map, const vec3& P, const vec3& N, float radius) {
  float v = -1;
  return map.lookup(P, N, radius, &v) ? v : -1;
}

TEST_F(BrickMaps, AConstantNeedsOneBrickAndIsFoundEverywhere) {
  PointCloud cloud;
  addSquare(cloud, 64, 0.3f, 1, [](float, float) { return 2.5f; });
  const BuiltBricks built = writeBrickMap(cloud, {}, path);
  EXPECT_EQ(built.tree.nodes.size(), 1u);
  EXPECT_GT(built.eliminated, 10);
  const BrickMap map(path, cache);
  for (int i = 0; i < 100; ++i) {
    const vec2 at = sobol2(static_cast<uint32_t>(i), 1);
    EXPECT_FLOAT_EQ(lookedUp(map, {at.x, at.y, 0.3f}, {0, 0, 1}, 0.01f), 2.5f);
  }
}

TEST_F(BrickMaps, WhereAWallPartsTwoLightsFinerVoxelsAnswerOrItIsToldThatNoneCan) {
  PointCloud cloud;
  cloud.channels = {{"value", 1}, kSurfaceChannel};
  constexpr int side = 128;
  for (int i = 0; i < side * side; ++i) {
    const vec2 at = (vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
    const bool mixed = at.x > 0.5f && at.x < 0.55f;
    const std::array value{at.x < 0.5f ? 100.0f : mixed ? 50.0f : 1.0f, mixed ? float{kAcrossWalls} : 1.0f};
    cloud.add({at.x, at.y, 0}, {0, 0, 1}, 0.8f / side, value.data());
  }
  writeBrickMap(cloud, {0.0001f}, path);
  const BrickMap map(path, cache);
  const auto look = [&](float x, float radius, bool& across) {
    float v = -1;
    EXPECT_TRUE(map.lookup({x, 0.5f, 0}, {0, 0, 1}, radius, &v, 1, &across));
    return v;
  };
  bool across = true;
  EXPECT_FLOAT_EQ(look(0.2f, 0.01f, across), 100);
  EXPECT_FALSE(across);
  EXPECT_FLOAT_EQ(look(0.7f, 0.2f, across), 1) << "coarse voxels hold both lights";
  EXPECT_FALSE(across);
  look(0.52f, 0.01f, across);
  EXPECT_TRUE(across);
  float v = -1;
  map.lookup({0.7f, 0.5f, 0}, {0, 0, 1}, 0.2f, &v, 1);
  EXPECT_GT(v, 1.2f) << "who does not ask gets the mean over the width";
}

TEST_F(BrickMaps, ALinearFunctionComesBackWithinHalfAVoxel) {
  PointCloud cloud;
  addSquare(cloud, 128, 0, 1, [](float x, float y) { return x + 2 * y; });
  writeBrickMap(cloud, {0.0001f}, path);
  const BrickMap map(path, cache);
  for (int i = 0; i < 200; ++i) {
    const vec2 at = 0.1f + 0.8f * sobol2(static_cast<uint32_t>(i), 1);
    EXPECT_NEAR(lookedUp(map, {at.x, at.y, 0}, {0, 0, 1}, 0.005f), at.x + 2 * at.y, 0.006f);
  }
}

TEST_F(BrickMaps, AWideLookupIsTheMeanAndReadsFewBricks) {
  PointCloud cloud;
  addSquare(cloud, 256, 0, 1, [](float x, float) { return std::sin(60 * x) > 0 ? 1.0f : 0.0f; });
  const BuiltBricks built = writeBrickMap(cloud, {}, path);
  const BrickMap map(path, cache);
  EXPECT_NEAR(lookedUp(map, {0.5f, 0.5f, 0}, {0, 0, 1}, 0.25f), 0.5f, 0.1f);
  EXPECT_LE(cache.misses(), 9);
  EXPECT_GT(built.tree.nodes.size(), 50u);
}

TEST_F(BrickMaps, TwoSidesOfALeafDoNotMix) {
  PointCloud cloud;
  addSquare(cloud, 64, 0, 1, [](float, float) { return 1.0f; });
  addSquare(cloud, 64, 0, -1, [](float, float) { return 0.0f; });
  writeBrickMap(cloud, {}, path);
  const BrickMap map(path, cache);
  for (const float radius : {0.001f, 0.01f, 0.1f, 1.0f}) {
    EXPECT_FLOAT_EQ(lookedUp(map, {0.4f, 0.6f, 0}, {0, 0, 1}, radius), 1.0f) << radius;
    EXPECT_FLOAT_EQ(lookedUp(map, {0.4f, 0.6f, 0}, {0, 0, -1}, radius), 0.0f) << radius;
  }
}

TEST_F(BrickMaps, SurfacesThatTouchDoNotMixWhereOneIsAskedFor) {
  PointCloud cloud;
  cloud.channels = {{"value", 1}, kSurfaceChannel};
  for (uint32_t i = 0; i < 8000; ++i) {
    const vec2 at = sobol2(i, 3);
    const std::array<float, 2> sheet{1, 1}, above{0, 2};
    cloud.add({at.x, at.y, 0}, {0, 0, -1}, 0.02f, sheet.data());
    cloud.add({at.x, at.y, 0.01f * at.x}, {0, 0, -1}, 0.02f, above.data());
  }
  writeBrickMap(cloud, {}, path);
  const BrickMap map(path, cache);
  EXPECT_EQ(map.width(), 1);
  const auto ask = [&](int surface, float radius) {
    float v = -1;
    map.lookup({0.3f, 0.5f, 0.003f}, {0, 0, -1}, radius, &v, surface);
    return v;
  };
  for (const float radius : {0.005f, 0.05f, 0.5f}) {
    EXPECT_FLOAT_EQ(ask(1, radius), 1) << radius;
    EXPECT_FLOAT_EQ(ask(2, radius), 0) << radius;
    EXPECT_NEAR(ask(0, radius), 0.5f, 0.2f) << radius;
    EXPECT_EQ(ask(3, radius), ask(0, radius)) << "of a surface that the map does not know";
  }
}

TEST_F(BrickMaps, NothingFacesALookupFromTheSide) {
  PointCloud cloud;
  addSquare(cloud, 16, 0, 1, [](float, float) { return 1.0f; });
  writeBrickMap(cloud, {}, path);
  const BrickMap map(path, cache);
  EXPECT_EQ(lookedUp(map, {0.5f, 0.5f, 0}, {1, 0, 0}, 0.1f), -1);
  EXPECT_EQ(lookedUp(map, {0.5f, 0.5f, 0}, vec3(0), 0.1f), 1);
  EXPECT_EQ(lookedUp(map, {50, 50, 0}, {0, 0, 1}, 0.1f), -1);
}

TEST_F(BrickMaps, LevelsBlendWithoutAStep) {
  PointCloud cloud;
  addSquare(cloud, 128, 0, 1, [](float x, float y) { return std::sin(20 * x) * std::cos(14 * y); });
  writeBrickMap(cloud, {}, path);
  const BrickMap map(path, cache);
  float previous = lookedUp(map, {0.43f, 0.57f, 0}, {0, 0, 1}, 0.002f);
  for (float radius = 0.002f; radius < 0.5f; radius *= 1.01f) {
    const float v = lookedUp(map, {0.43f, 0.57f, 0}, {0, 0, 1}, radius);
    EXPECT_NEAR(v, previous, 0.03f) << radius;
    previous = v;
  }
}

TEST_F(BrickMaps, TheCacheStaysInItsBudgetAndChangesNoResult) {
  PointCloud cloud;
  addSquare(cloud, 256, 0, 1, [](float x, float y) { return std::sin(90 * x) * std::sin(70 * y); });
  writeBrickMap(cloud, {}, path);
  BrickCache none(0), small(200'000);
  const BrickMap a(path, none), b(path, small), c(path, cache);
  for (int i = 0; i < 500; ++i) {
    const vec2 at = sobol2(static_cast<uint32_t>(i), 7);
    const float expected = lookedUp(c, {at.x, at.y, 0}, {0, 0, 1}, 0.003f);
    EXPECT_EQ(lookedUp(a, {at.x, at.y, 0}, {0, 0, 1}, 0.003f), expected);
    EXPECT_EQ(lookedUp(b, {at.x, at.y, 0}, {0, 0, 1}, 0.003f), expected);
    EXPECT_LE(small.bytes(), 200'000u);
  }
  EXPECT_EQ(none.misses(), none.lookups());
  EXPECT_EQ(none.bytes(), 0u);
  EXPECT_LT(cache.misses(), small.misses());
}

TEST_F(BrickMaps, PointsOnDiskMakeTheSameMapHoweverFewFitIntoMemory) {
  PointCloud cloud;
  addSquare(cloud, 64, 0.1f, 1, [](float x, float y) { return std::sin(9 * x) * y; });
  addSquare(cloud, 32, 0.7f, -1, [](float x, float) { return x; });
  const std::string points = (folder / "a.ptc").string();
  writePointFile(cloud, points);
  const PointFile file(points);
  const PointTiles tiles(file);
  const auto bricksOf = [](const auto& build) {
    std::vector<Brick> out;
    const BuiltBricks built = build([&](const Brick& b) { out.push_back(b); });
    EXPECT_EQ(built.tree.nodes.size(), out.size());
    return out;
  };
  const auto whole = bricksOf([&](const auto& store) { return buildBricks(file.readAll(), {}, store); });
  for (const uint64_t most : {1000u, 3000u, 1000000u}) {
    const auto parts = bricksOf([&](const auto& store) { return buildBricks(tiles, {}, store, most); });
    ASSERT_EQ(parts.size(), whole.size()) << most;
    for (size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(parts[i].bytes(), whole[i].bytes()) << most;
  }
}

TEST_F(BrickMaps, ThreeChannelsAreThreeMapsOfOne) {
  std::array<PointCloud, 4> clouds;  // of all three, and of each
  clouds[0].channels = {{"value", 3}};
  for (size_t k = 1; k < clouds.size(); ++k) clouds[k].channels = {{"value", 1}};
  for (uint32_t i = 0; i < 3000; ++i) {
    const vec2 at = sobol2(i, 5);
    const vec3 N = i % 3 == 0 ? vec3(0, 0, 1) : normalize(vec3(at.x, 1, 0));
    const std::array values{at.x, std::sin(9 * at.y), i % 3 == 0 ? 1.0f : 0.0f};
    clouds[0].add({at, 0}, N, 0.02f, values.data());
    for (size_t k = 0; k < 3; ++k) clouds[k + 1].add({at, 0}, N, 0.02f, &values[k]);
  }
  const std::array<BrickMap, 4> maps{BrickMap(clouds[0]), BrickMap(clouds[1]), BrickMap(clouds[2]),
                                     BrickMap(clouds[3])};
  for (uint32_t i = 0; i < 200; ++i) {
    const vec2 at = sobol2(i, 6);
    std::array<float, 3> all;
    ASSERT_TRUE(maps[0].lookup({at, 0}, {0, 0, 1}, 0.02f, all.data()));
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(all[k], lookedUp(maps[k + 1], {at, 0}, {0, 0, 1}, 0.02f), 1e-5f) << k;
  }
}

/// Layers of some voxels: one, none, or several, each with two floats.
Brick::Parts someParts(float scale) {
  Brick::Parts parts;
  for (uint16_t v = 3; v < kBrickVoxels; v = static_cast<uint16_t>(v + 7))
    for (uint32_t l = 0; l < (v % 5 ? 1u : 3u); ++l) {
      const float value = scale * unitFloat(hashCombine(v, l));
      parts.voxels.push_back(v);
      parts.layers.emplace_back(vec3(l == 0, l == 1, l == 2), v % 2 == 0);
      parts.data.insert(parts.data.end(), {value, 5 - 2 * value});
    }
  return parts;
}

TEST(Brick, HoldsItsLayersWithinASixteenthOfTheTolerance) {
  const Brick::Parts parts = someParts(40);
  for (const float tolerance : {0.0f, 0.005f, 0.03f, 10.0f}) {
    const Brick brick(parts, 2, tolerance);
    const bool rounded = 40 * 2 / 65535.0f / 2 < tolerance / 16;
    EXPECT_EQ(brick.bytes().size() < Brick(parts, 2, 0).bytes().size(), rounded) << tolerance;
    size_t l = 0;
    for (int v = 0; v < kBrickVoxels; ++v)
      for (auto [i, end] = brick.layersOf(v); i < end; ++i, ++l) {
        ASSERT_LT(l, parts.voxels.size());
        EXPECT_EQ(i, l);
        EXPECT_EQ(parts.voxels[l], v);
        EXPECT_EQ(brick.layer(i).normal(), parts.layers[l].normal());
        EXPECT_EQ(brick.layer(i).incoherent, parts.layers[l].incoherent);
        float got[3] = {1, 1, 7};
        brick.add(i, 0.5f, got);
        EXPECT_EQ(got[2], 7) << "beyond its width";
        for (int k = 0; k < 2; ++k)
          EXPECT_NEAR(got[k], 1 + 0.5f * parts.data[2 * l + static_cast<size_t>(k)], tolerance / 32 + 1e-5f);
      }
    EXPECT_EQ(l, parts.voxels.size());
  }
}

TEST(BrickCache, KeepsWhatIsAskedForAgainAndAgain) {
  BrickCache cache(16 * 20'000);  // some ten bricks in each of its parts
  int read = 0;
  const auto make = [&] { return Brick(someParts(1), 2, 0); };
  for (uint32_t i = 1; i < 2000; ++i) {
    cache.get(0, 0, [&] {
      ++read;
      return make();
    });
    cache.get(0, i, make);
    ASSERT_LE(cache.bytes(), size_t{16 * 20'000});
  }
  EXPECT_EQ(read, 1);
  EXPECT_EQ(cache.misses(), 2000);
}

TEST(Brick, IsMadeOfItsBytesAndOfNoOthers) {
  const Brick brick(someParts(1), 2, 0.01f);
  ASSERT_TRUE(Brick::of(brick.bytes(), 2));
  EXPECT_EQ(Brick::of(brick.bytes(), 2)->bytes(), brick.bytes());
  EXPECT_FALSE(Brick::of(brick.bytes(), 3));
  EXPECT_FALSE(Brick::of({}, 2));
  std::vector<std::byte> longer = brick.bytes(), shorter = brick.bytes();
  longer.push_back({});
  shorter.pop_back();
  EXPECT_FALSE(Brick::of(longer, 2));
  EXPECT_FALSE(Brick::of(shorter, 2));
  for (size_t at = 0; at < brick.bytes().size(); ++at) {  // whatever is in them, no voxel has layers that are not there
    std::vector<std::byte> changed = brick.bytes();
    changed[at] ^= std::byte{0x55};
    const auto other = Brick::of(changed, 2);
    float sum[3] = {0, 0, 0};
    for (int v = 0; other && v < kBrickVoxels; ++v)
      for (auto [i, end] = other->layersOf(v); i < end; ++i) other->add(i, other->layer(i).normal().x, sum);
  }
}

TEST(BrickLayer, AnswersNormalsWithin45Degrees) {
  for (uint32_t i = 0; i < 2000; ++i) {
    const vec2 a = sobol2(i, 1), b = sobol2(i, 2);
    const vec3 n = cosineHemisphere(a), m = cosineHemisphere(b);
    const float cosine = dot(n, m);
    if (std::abs(cosine - kLayerCosine) < 0.01f) continue;
    EXPECT_EQ(BrickLayer(n, false).answers(m), cosine > kLayerCosine);
    EXPECT_GT(dot(BrickLayer(n, false).normal(), n), 0.9999f);
  }
  EXPECT_TRUE(BrickLayer(vec3(0, 0, 1), false).answers(vec3(0)));
  EXPECT_TRUE(BrickLayer(vec3(0), false).answers(vec3(0, 0, 1)));
}

TEST_F(BrickMaps, ScaledRadiiReachFromCubesThatAreNotInMemory) {
  PointCloud cloud;
  addSquare(cloud, 64, 0.1f, 1, [](float x, float y) { return x * y; });
  const std::string points = (folder / "a.ptc").string();
  writePointFile(cloud, points);
  const PointFile file(points);
  const BrickSettings wide{.radiusScale = 2};
  std::vector<Brick> whole, parts;
  buildBricks(file.readAll(), wide, [&](const Brick& b) { whole.push_back(b); });
  buildBricks(
      PointTiles(file), wide, [&](const Brick& b) { parts.push_back(b); }, 1300);
  ASSERT_EQ(parts.size(), whole.size());
  for (size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(parts[i].bytes(), whole[i].bytes());
}

TEST_F(BrickMaps, EveryPointLiesInOneTileAndCompactChunksHoldTheSamePoints) {
  PointCloud cloud;
  cloud.channels = {{"value", 1}};
  for (uint32_t i = 0; i < 60000; ++i) {  // in no order, many on borders of cubes
    const vec2 at = sobol2(hash32(i), 3);
    const float value = static_cast<float>(i);
    cloud.add({std::round(at.x * 64) / 64, at.y, 0.1f * at.x}, {0, 0, 1}, 0, &value);
  }
  const std::string scattered = (folder / "s.ptc").string(), compact = (folder / "c.ptc").string();
  PointFileWriter writer(scattered, cloud.channels);
  for (size_t i = 0; i < cloud.count(); ++i) writer.add(cloud.position[i], cloud.normal[i], 0, cloud.at(i));
  writer.finish();
  const PointFile file(scattered);
  PointTiles(file).writeCompact(compact);
  const PointFile sorted(compact);
  const PointTiles tiles(sorted);
  uint64_t found = 0;
  std::vector<int> times(cloud.count(), 0);
  forEachTile(tiles, 2000, [&](int level, const glm::ivec3& place) {
    const PointCloud near = tiles.around(tiles.box(level, place), 0.01f);
    uint64_t here = 0;
    for (size_t i = 0; i < near.count(); ++i)
      if (tiles.contains(level, place, near.position[i])) {
        ++times[static_cast<size_t>(near.at(i)[0])];
        ++here;
      }
    EXPECT_EQ(here, tiles.count(level, place));
    found += here;
  });
  EXPECT_EQ(found, cloud.count());
  EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
  const auto volume = [](const PointFile& f) {
    float sum = 0;
    for (size_t c = 0; c < f.chunkCount(); ++c) sum += f.chunkBound(c).size().x * f.chunkBound(c).size().y;
    return sum / static_cast<float>(f.chunkCount());
  };
  EXPECT_GT(volume(file), 0.9f);
  EXPECT_LT(volume(sorted), 0.1f);
}

TEST_F(BrickMaps, ALookupWithoutANumberFindsNothing) {
  PointCloud cloud;
  addSquare(cloud, 16, 0, 1, [](float x, float) { return x; });
  writeBrickMap(cloud, {}, path);
  const BrickMap map(path, cache);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(lookedUp(map, {0.5f, 0.5f, 0}, {0, 0, 1}, nan), -1);
  EXPECT_EQ(lookedUp(map, {nan, 0.5f, 0}, {0, 0, 1}, 0.1f), -1);
}

TEST_F(BrickMaps, FilesWithPointsOrVoxelsThatAreNoNumbersAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string points = (folder / "nan.ptc").string();
  for (int what = 0; what < 4; ++what) {
    PointCloud cloud;
    cloud.channels = {{"value", 1}};
    const float good = 1, value = what == 0 ? nan : 1;
    cloud.add({0, 0, 0}, {0, 0, 1}, 1, &good);
    cloud.add({what == 1 ? nan : 1, 1, 1}, {0, 0, 1}, what == 2 ? nan : 1, &value);
    if (what == 3) cloud.position[1].x = kInfinity;
    PointFileWriter writer(points, cloud.channels);
    writer.addChunk(cloud);  // which looks at nothing
    writer.finish();
    EXPECT_THROW(PointFile(points).readAll(), FileError) << what;
  }
  PointCloud cloud;
  addSquare(cloud, 4, 0, 1, [&](float, float) { return nan; });
  writeBrickMap(cloud, {}, path);
  EXPECT_THROW(lookedUp(BrickMap(path, cache), {0.5f, 0.5f, 0}, {0, 0, 1}, 0.1f), FileError);
}

TEST_F(BrickMaps, SumsOfEnormousLightStayNumbers) {
  PointCloud cloud;
  addSquare(cloud, 64, 0, 1, [](float x, float) { return x < 0.5f ? 3e38f : -3e38f; });
  writeBrickMap(cloud, {}, path);
  EXPECT_GT(lookedUp(BrickMap(path, cache), {0.2f, 0.5f, 0}, {0, 0, 1}, 0.1f), 1e37f);
}

TEST_F(BrickMaps, TinyAndHugeSurfacesKeepTheirDirectionsApart) {
  for (const float scale : {1e-9f, 1e9f}) {
    PointCloud cloud;
    cloud.channels = {{"value", 1}};
    for (int i = 0; i < 64; ++i) {
      const vec3 at(static_cast<float>(i % 8), static_cast<float>(i / 8), 0);
      for (const float side : {1.0f, -1.0f}) cloud.add(scale * at, {0, 0, side}, scale, &side);
    }
    writeBrickMap(cloud, {}, path);
    const BrickMap map(path, cache);
    EXPECT_EQ(lookedUp(map, scale * vec3(3, 3, 0), {0, 0, 1}, scale), 1) << scale;
    EXPECT_EQ(lookedUp(map, scale * vec3(3, 3, 0), {0, 0, -1}, scale), -1) << scale;
  }
}

TEST_F(BrickMaps, AnEmptyCloudAndASinglePointMakeMaps) {
  PointCloud cloud;
  cloud.channels = {{"value", 1}};
  writeBrickMap(cloud, {}, path);
  EXPECT_EQ(lookedUp(BrickMap(path, cache), vec3(0), {0, 0, 1}, 1), -1);
  const float v = 3;
  cloud.add({1, 2, 3}, {0, 0, 1}, 0.5f, &v);
  writeBrickMap(cloud, {}, path);
  EXPECT_EQ(lookedUp(BrickMap(path, cache), {1, 2, 3}, {0, 0, 1}, 0.1f), 3);
}

TEST_F(BrickMaps, ADamagedFileIsAnErrorAndNeverOtherData) {
  PointCloud cloud;
  addSquare(cloud, 8, 0, 1, [](float x, float) { return x; });
  writeBrickMap(cloud, {}, path);
  const float expected = lookedUp(BrickMap(path, cache), {0.3f, 0.3f, 0}, {0, 0, 1}, 0.01f);
  std::ifstream in(path, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  for (size_t i = 0; i < whole.size(); i += 3) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
    std::ofstream(path, std::ios::binary | std::ios::trunc) << flipped;
    BrickCache fresh;
    try {
      EXPECT_EQ(lookedUp(BrickMap(path, fresh), {0.3f, 0.3f, 0}, {0, 0, 1}, 0.01f), expected) << "byte " << i;
    } catch (const FileError&) {
    }
  }
}

TEST_F(BrickMaps, FilesWhoseNodesAreNoTreeAreRefused) {
  const auto refuses = [&](const std::vector<BrickNode>& nodes, int deepest) {
    BrickFileWriter file(path);
    for (size_t i = 0; i < nodes.size(); ++i) file.add(Brick(Brick::Parts(), 1, 0));
    BrickTree tree;
    tree.nodes = nodes;
    tree.deepest = deepest;
    file.finish({{"value", 1}}, tree, {});
    try {
      const BrickFile opened(path);
    } catch (const DamageError&) {
      return true;
    }
    return false;
  };
  BrickNode one, both;
  one.child[0] = 0;
  both.child[0] = both.child[1] = 0;
  EXPECT_FALSE(refuses({{}, one}, 1));
  EXPECT_TRUE(refuses({{}, both}, 1)) << "a node that hangs on its parent twice";
  EXPECT_TRUE(refuses({{}, one}, 0)) << "more levels than it says";
  EXPECT_TRUE(refuses({{}, one}, 5)) << "fewer levels than it says";
  EXPECT_TRUE(refuses({{}, {}}, 1)) << "a node that hangs on nothing";
  EXPECT_TRUE(refuses({{}}, 22)) << "more levels than there may be";
}

}  // namespace
}  // namespace tomales
