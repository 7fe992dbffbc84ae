// The hair rule (Tabellion and Lamorlette 2004, section 4.5): geometry names the place where its indirect light is
// gathered.
#include <gtest/gtest.h>

#include <set>

#include "fixture.h"
#include "gi/frame/gather_tile.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

using namespace test;

constexpr float kGround = -0.6f;
Param triple(const std::string& name, ValueType type, const vec3& v) {
  return {name, Storage::Uniform, type, 1, {v.x, v.y, v.z}, {}, {}};
}

/// A lit ground with blades on it that gather rays do not see; each has its root in the middle of its lower edge.
SceneBuilder meadow(bool rooted, int blades) {
  SceneBuilder b;
  b.light("pointlight", {floatParam("intensity", 4), pointParam("from", {0.3f, 1.2f, 2.5f})});
  b.light("indirectlight", {floatParam("samples", 200)});
  b.quad({-3, kGround, 1}, {3, kGround, 1}, {3, kGround, 6}, {-3, kGround, 6}, vec3(0.5f));
  b.quad({1, kGround, 1}, {1, 2, 1}, {1, 2, 6}, {1, kGround, 6}, {0.8f, 0.3f, 0.2f});
  for (int k = 0; k < blades; ++k) {
    const float x = -0.9f + 0.4f * static_cast<float>(k), z = 3;
    Problems problems;
    Param P{"P",
            Storage::Vertex,
            ValueType::Point,
            1,
            {x, kGround, z, x + 0.1f, kGround, z, x + 0.1f, 0.5f, z, x, 0.5f, z},
            {},
            {}};
    ParamList params{P};
    if (rooted) {
      params.push_back(triple("gatherP", ValueType::Point, {x + 0.05f, kGround, z}));
      params.push_back(triple("gatherN", ValueType::Normal, {0, 2, 0}));
    }
    b.add(makePolygons({4}, {0, 1, 2, 3}, params, problems), vec3(0.5f));
    auto hidden = std::make_shared<Attributes>(*b.scene.objects.back().attributes);
    hidden->visibility.diffuse = false;
    b.scene.objects.back().attributes = hidden;
  }
  return b;
}

TEST(GatherPlaces, RecordsOfBladesLieAtTheirRoots) {
  constexpr int kBlades = 4;
  World world(meadow(true, kBlades).scene);
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({});
  gatherFrame(*services, frame);
  std::set<float> roots;
  for (const IrradianceRecord& r : services->caches()[0].cache.records()) {
    if (r.position.x > 0.99f) continue;  // of the wall
    EXPECT_NEAR(r.position.y, kGround, 1e-4f);
    if (std::abs(r.position.z - 3) < 1e-5f) roots.insert(r.position.x);
  }
  EXPECT_FALSE(roots.empty());
  EXPECT_LE(roots.size(), static_cast<size_t>(kBlades));
}

TEST(GatherPlaces, ABladeHasTheLightOfItsRoot) {
  World world(meadow(true, 2).scene);
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({});
  gatherFrame(*services, frame);
  int seen = 0;
  for (const DeepTile& tile : frame.tiles)
    for (const ShadePoints& batch : tile.batches) {
      const ShadeGroup& group = world.scene.groups[static_cast<size_t>(batch.group())];
      if (offsetOf(group.primvars, "gatherP") < 0) continue;
      const std::vector<vec3> E = indirectAt(*services, batch, *world.shading.group(batch.group()).indirectQuery());
      for (int i = 0; i < batch.count(); ++i) {
        const vec3 root{batch.primvar(offsetOf(group.primvars, "gatherP"))[i], kGround, 3};
        const IrradianceRecord truth =
            gather(world.rays, world.shading, {batch.group(), root, {0, 1, 0}, 5, 0.01f, 0.01f}, {.samples = 20000}, {},
                   world.stats);
        EXPECT_NEAR(luminance(E[static_cast<size_t>(i)]) / luminance(truth.light.E), 1, 0.06f) << batch.position(i).y;
        EXPECT_EQ(E[static_cast<size_t>(i)], E.front()) << "all of a blade alike";
        if (++seen > 20) return;
      }
    }
  EXPECT_GT(seen, 10);
}

TEST(GatherPlaces, BladesWithoutRootsNeedManyMoreRecords) {
  const auto records = [](bool rooted) {
    World world(meadow(rooted, 5).scene);
    const DeepFrame frame = frameOf(world, 16);
    const auto services = world.use({});
    gatherFrame(*services, frame);
    return static_cast<int64_t>(world.stats.irradianceCache.samples);
  };
  EXPECT_LT(records(true) + 25, records(false));
}

TEST(GatherPlaces, TheReferenceGathersThereToo) {
  World world(meadow(true, 1).scene);
  const DeepFrame frame = frameOf(world, 64);
  const auto cached = world.use({});
  gatherFrame(*cached, frame);
  GiSettings settings;
  settings.mode = GiMode::Reference;
  settings.samples = 4096;
  const auto reference = world.use(settings);
  int found = 0;
  for (const ShadePoints& batch : frame.tiles[0].batches) {
    if (offsetOf(world.scene.groups[static_cast<size_t>(batch.group())].primvars, "gatherP") < 0) continue;
    ShadePoints top(batch.group(), batch.primvarFloats());
    top.assign(batch, 0, 1);
    const IndirectQuery& query = *world.shading.group(batch.group()).indirectQuery();
    EXPECT_NEAR(luminance(indirectAt(*cached, top, query)[0]) / luminance(indirectAt(*reference, top, query)[0]), 1,
                0.06f);
    ++found;
  }
  EXPECT_GT(found, 0);
}

constexpr int kSide = 8, kPixels = kSide * kSide;

/// Pixel p sees point p, and point p + 1 behind it. The first of them move if `drift` is not 0.
DeepTile tileOfPairs(float drift) {
  DeepTile tile;
  tile.rect = {16, 32, 16 + kSide, 32 + kSide};
  ShadePoints& batch = tile.batches.emplace_back(0, 0);
  for (int i = 0; i <= kPixels; ++i) {
    batch.add(hash32(static_cast<uint32_t>(i)));
    batch.set3(kPx, i, {static_cast<float>(i), 0, 5});
    batch.set3(kIx, i, {0, 0, 5});
    batch.set3(kNx, i, {0, 0, -1});
    batch.set3(kNgx, i, {0, 0, -1});
    batch.set3(kDpduX, i, {1, 0, 0});
    batch.set3(kDpdvX, i, {0, 0, 0});
    batch.set3(kDriftX, i, {i < 20 ? drift : 0, 0, 0});
    batch.channel(kDu)[i] = 0.5f;
    batch.channel(kDv)[i] = 0.5f;
    batch.channel(kTime)[i] = -1;
    tile.facets.push_back({0, {i, i, i, i}});
  }
  for (uint32_t p = 0; p < kPixels; ++p) {
    tile.pixels.push_back({2 * p, 2});
    for (uint32_t k = 0; k < 2; ++k) tile.fragments.push_back({p + k, 5, 1});
  }
  return tile;
}

struct GatherTileTest : ::testing::Test {
  World world{cornell().scene};
  GiState state{world.scene, world.camera, {}, world.shading, {}, world.stats};
};

TEST_F(GatherTileTest, AsksForTheNearestPointOfEachPixelAndForEveryOtherPointOnce) {
  const DeepTile tile = tileOfPairs(0);
  const GatherTile made(state, tile, std::vector<uint8_t>(world.scene.groups.size(), 1));
  std::vector<int> nearest(kPixels), late(kPixels + 1);
  for (int phase = 0; phase < kGatherPhases; ++phase)
    made.forPoints(world.camera, phase, [&](const GatherPoint& p, int x, int y) {
      const int pixel = (y - 32) * kSide + x - 16, point = static_cast<int>(p.position.x);
      EXPECT_EQ(p.key, tile.batches[0].key(point));
      EXPECT_EQ(p.edgeLength, 0.5f);
      EXPECT_EQ(p.pixelSize, projectedPixelSize(world.camera, p.position, p.normal));
      if (phase < kLatticePhases) {
        EXPECT_EQ(point, pixel);
        EXPECT_EQ(phase, latticePhase(x, y));
        ++nearest[static_cast<size_t>(pixel)];
      } else {
        EXPECT_EQ(point, pixel + 1);
        ++late[static_cast<size_t>(point)];
      }
    });
  EXPECT_EQ(nearest, std::vector<int>(kPixels, 1));
  EXPECT_EQ(late[0], 0) << "no pixel sees it behind another";
  EXPECT_EQ(std::vector<int>(late.begin() + 1, late.end()), std::vector<int>(kPixels, 1));
  EXPECT_LT(3 * made.bytes(), tile.bytes());
}

TEST_F(GatherTileTest, AsksForNothingWhereNothingIsGathered) {
  const GatherTile made(state, tileOfPairs(0), std::vector<uint8_t>(world.scene.groups.size(), 0));
  for (int phase = 0; phase < kGatherPhases; ++phase)
    made.forPoints(world.camera, phase, [](const GatherPoint&, int, int) { ADD_FAILURE(); });
}

TEST_F(GatherTileTest, MovingAndStillPointsKeepTheirDriftAndTime) {
  const DeepTile tile = tileOfPairs(2);
  const GatherTile made(state, tile, std::vector<uint8_t>(world.scene.groups.size(), 1));
  for (int phase = 0; phase < kGatherPhases; ++phase)
    made.forPoints(world.camera, phase, [&](const GatherPoint& p, int, int) {
      EXPECT_EQ(p.drift.x, p.position.x < 20 ? 2.0f : 0.0f) << p.position.x;
      EXPECT_EQ(p.time, -1);
    });
}

}  // namespace
}  // namespace tomales
