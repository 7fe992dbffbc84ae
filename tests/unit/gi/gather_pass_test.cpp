#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "gi/frame/gather_places.h"
#include "gi/gather/occluders.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"
#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;

TEST(LatticePhase, EachPhaseIsALatticeTwiceAsDenseAsAllBeforeIt) {
  std::map<int, int> pixels;
  for (int y = -32; y < 32; ++y)
    for (int x = -32; x < 32; ++x) ++pixels[latticePhase(x, y)];
  ASSERT_EQ(pixels.size(), static_cast<size_t>(kLatticePhases));
  int before = 0;
  for (const auto& [phase, count] : pixels) {
    EXPECT_EQ(count, phase == 0 ? 16 : before) << phase;
    before += count;
  }
}

TEST(LatticePhase, NeighboursOfAPhaseAreAsFarApartAsItsDensityAllows) {
  for (int phase = 0; phase < kLatticePhases; ++phase) {
    int nearest = 1 << 20;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        for (int dy = -16; dy <= 16; ++dy)
          for (int dx = -16; dx <= 16; ++dx)
            if ((dx || dy) && latticePhase(x, y) == phase && latticePhase(x + dx, y + dy) == phase)
              nearest = std::min(nearest, dx * dx + dy * dy);
    EXPECT_EQ(nearest, phase == 0 ? 256 : 512 >> phase) << phase;
  }
}

ParamList indirect(float samples, float maxError = 1) {
  return {floatParam("samples", samples), floatParam("maxerror", maxError)};
}

TEST(GatherPass, CoversEveryPointOfTheFrameWithFarFewerRecords) {
  World world(cornell(indirect(64)).scene);
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({});
  gatherFrame(*services, frame);
  const int64_t samples = world.stats.irradianceCache.samples;
  EXPECT_LT(samples, 64 * 64 / 4);
  EXPECT_GT(samples, 64 * 64 / 300);
  const int64_t rays = world.stats.rays.gather;
  EXPECT_GE(rays, samples * 65);  // 64 asked for: 5 x 13 cells
  EXPECT_LE(rays, samples * 65 * 3 / 2 + 2 * 64 * 64)
      << "up to half as many more where light changes fast, and two for each point that may lie in a slot";
  indirectOf(*services, world, frame);
  EXPECT_EQ(world.stats.irradianceCache.interpolated, world.stats.irradianceCache.lookups);
  EXPECT_GT(world.stats.irradianceCache.lookups, 3000);
  EXPECT_EQ(world.stats.rays.gather, rays);
}

/// Attribute "grouping" "tracesubset" decides what a record sees, so neighbours with another one cannot use it.
TEST(GatherPass, ObjectsWhoseRaysSeeDifferentSubsetsShareNoRecords) {
  SceneBuilder b = cornell(indirect(64));
  auto blind = std::make_shared<Attributes>(*b.scene.objects[2].attributes);  // the back wall
  blind->trace.subset = "nothing";
  b.scene.objects[2].attributes = blind;
  World world(std::move(b.scene));
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({});
  gatherFrame(*services, frame);
  ASSERT_EQ(services->caches().size(), 2U);
  int dark = 0;
  for (const PreparedCache& c : services->caches())
    dark += !c.cache.records().empty() && std::all_of(c.cache.records().begin(), c.cache.records().end(),
                                                      [](const IrradianceRecord& r) { return r.light.E == vec3(0); });
  EXPECT_EQ(dark, 1);
}

TEST(GatherPass, TheCacheDoesNotDependOnThreadsOrBuckets) {
  World world(cornell(indirect(32)).scene);
  std::vector<vec3> first;
  for (const int threads : {1, 4})
    for (const int bucket : {16, 13}) {
      const ThreadLimit limit(threads);
      const DeepFrame frame = frameOf(world, bucket);
      const auto services = world.use({});
      gatherFrame(*services, frame);
      const std::vector<vec3> E = indirectOf(*services, world, frame);
      if (first.empty()) first = E;
      EXPECT_EQ(E, first) << threads << " threads, buckets of " << bucket;
    }
}

/// Returns how many records a frame adds to those given.
int64_t added(World& world, std::vector<PreparedCache>& caches, const DeepFrame& frame) {
  const auto records = [&] { return static_cast<int64_t>(caches[0].cache.records().size()); };
  const auto services = world.use({});
  const int64_t before = records();
  services->useCaches(std::move(caches));
  gatherFrame(*services, frame);
  caches = services->takeCaches();
  return records() - before;
}

TEST(GatherPass, AFrameAddsRecordsOnceAndIsKnownByWhatItsPixelsSee) {
  World world(cornell(indirect(16)).scene);
  const auto services = world.use({});
  gatherFrame(*services, frameOf(world, 16));
  std::vector<PreparedCache> caches = services->takeCaches();
  EXPECT_EQ(added(world, caches, frameOf(world, 16)), 0);
  EXPECT_EQ(added(world, caches, frameOf(world, 64)), 0) << "other buckets";

  World closer(cornell(indirect(16), 72).scene);
  EXPECT_GT(added(closer, caches, frameOf(closer, 16)), 0) << "other pixels";
  EXPECT_EQ(added(closer, caches, frameOf(closer, 16)), 0);
  EXPECT_EQ(added(world, caches, frameOf(world, 16)), 0) << "not the last frame, but one of them";
  ASSERT_EQ(caches.size(), 1U);
  caches[0].frames.clear();
  EXPECT_GT(added(world, caches, frameOf(world, 16)), 0) << "what disagrees is refined in frames that are new";
}

/// Returns E of all records of a floor, sorted. Light comes from far away, so the true E is the same everywhere.
std::vector<double> recordsUnderAFarCeiling(float samples, uint32_t seed = 0) {
  SceneBuilder b(64);
  b.light("distantlight", {pointParam("from", {0, 0, 0}), pointParam("to", {0, 1, 0})});
  b.light("indirectlight", indirect(samples, 0.1f));
  b.quad({-1, -1, 2.2f}, {1, -1, 2.2f}, {1, -1, 4.2f}, {-1, -1, 4.2f}, vec3(0));
  b.quad({-3e3f, 9e3f, -3e3f}, {3e3f, 9e3f, -3e3f}, {3e3f, 9e3f, 3e3f}, {-3e3f, 9e3f, 3e3f}, vec3(0.7f));
  World world(std::move(b.scene));
  GiSettings settings;
  settings.seed = seed;
  const auto services = world.use(settings);
  gatherFrame(*services, frameOf(world, 64));
  std::vector<double> E;
  for (const IrradianceRecord& r : services->caches().at(0).cache.records()) E.push_back(double{luminance(r.light.E)});
  std::sort(E.begin(), E.end());
  return E;
}

/// Records of 512 rays or more share their directions (docs/decisions/0095).
TEST(GatherPass, RecordsOfManyRaysMissTheSameAndAreRightInTheMean) {
  const auto quantile = [](const std::vector<double>& E, double q) {
    return E[static_cast<size_t>(q * static_cast<double>(E.size() - 1))];
  };
  constexpr int kSeeds = 8;
  double mean = 0, ownRange = 0, sharedRange = 0;
  for (uint32_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<double> own = recordsUnderAFarCeiling(500, seed), shared = recordsUnderAFarCeiling(520, seed);
    ASSERT_GT(shared.size(), 100U);
    EXPECT_LT(quantile(shared, 0.8) - quantile(shared, 0.2), 0.2 * (quantile(own, 0.8) - quantile(own, 0.2)));
    ownRange += own.back() - own.front();
    sharedRange += shared.back() - shared.front();
    mean += quantile(shared, 0.5) / kSeeds;
  }
  EXPECT_LT(sharedRange, 0.4 * ownRange) << "those that look for bright spots are no records";
  // Form factor of a parallel square, whose quarters are a third of its height wide.
  const double side = 1.0 / 3, reach = std::sqrt(1 + side * side);
  const double exact = 0.7 * 4 / double{kPi} * side / reach * std::atan(side / reach);
  EXPECT_NEAR(mean, exact, 0.03 * exact);
}

TEST(GatherPass, BouncesDoNotDependOnThreadsOrBuckets) {
  World world(cornell(indirect(32)).scene);
  std::vector<vec3> first, one;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    const DeepFrame frame = frameOf(world, threads == 1 ? 16 : 13);
    const auto services = world.use({.bounces = 3});
    gatherFrame(*services, frame);
    const std::vector<vec3> E = indirectOf(*services, world, frame);
    if (first.empty()) first = E;
    EXPECT_EQ(E, first) << threads;
  }
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({});
  gatherFrame(*services, frame);
  one = indirectOf(*services, world, frame);
  const auto sum = [](const std::vector<vec3>& all) { return std::accumulate(all.begin(), all.end(), vec3(0)); };
  EXPECT_GT(sum(first).x, 1.2f * sum(one).x);
}

// A room with bumps all over; normals turn by up to 40 degrees.
struct BumpedRoom {
  explicit BumpedRoom(float displacementBound) : world(scene(displacementBound)), frame(frameOf(world, 16)) {
    for (DeepTile& tile : frame.tiles)
      for (ShadePoints& batch : tile.batches)
        for (int i = 0; i < batch.count(); ++i) {
          const uint32_t key = batch.key(i);
          const vec3 turn{unitFloat(hash32(key)), unitFloat(hash32(key ^ 1)), unitFloat(hash32(key ^ 2))};
          batch.set3(kNx, i, glm::normalize(batch.get3(kNx, i) + 0.9f * (turn - vec3(0.5f))));
        }
  }
  static Scene scene(float displacementBound) {
    SceneBuilder b = cornell(indirect(256));
    for (Object& o : b.scene.objects) {
      auto attributes = std::make_shared<Attributes>(*o.attributes);
      attributes->displacement = std::make_shared<ShaderCall>(call("noisybump", {floatParam("moves", 0)}));
      attributes->displacementBound = displacementBound;
      o.attributes = attributes;
    }
    return b.scene;
  }
  World world;
  DeepFrame frame;
};

TEST(GatherPass, BumpsTakeNoRecordsAndAreStillSeen) {
  BumpedRoom bumps(0), unseenDisplacement(1e-4f);
  for (BumpedRoom* room : {&bumps, &unseenDisplacement}) gatherFrame(*room->world.use({}), room->frame);
  EXPECT_LT(bumps.world.stats.irradianceCache.samples * 3, unseenDisplacement.world.stats.irradianceCache.samples);
  const auto services = bumps.world.use({});
  gatherFrame(*services, bumps.frame);
  const std::vector<vec3> E = indirectOf(*services, bumps.world, bumps.frame);
  EXPECT_EQ(bumps.world.stats.irradianceCache.interpolated, bumps.world.stats.irradianceCache.lookups);
  const auto everyPoint = bumps.world.use({.maxError = 0});
  const std::vector<vec3> truth = indirectOf(*everyPoint, bumps.world, bumps.frame);
  float error = 0, mean = 0;
  for (size_t i = 0; i < E.size(); ++i) {
    error += std::abs(luminance(E[i]) - luminance(truth[i]));
    mean += luminance(truth[i]);
  }
  EXPECT_LT(error / mean, 0.08f);
}

TEST(GatherPass, UnderASheetAsHighAsAPixelLightIsThatOfTheSlot) {
  SceneBuilder room = cornell(indirect(128));
  room.quad({0.2f, -0.96f, 2.6f}, {0.9f, -0.96f, 2.6f}, {0.9f, -0.96f, 3.0f}, {0.2f, -0.96f, 3.0f}, vec3(0.7f));
  World world(std::move(room.scene));
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({});
  gatherFrame(*services, frame);
  const std::vector<vec3> E = indirectOf(*services, world, frame);
  const auto everyPoint = world.use({.maxError = 0});
  const std::vector<vec3> truth = indirectOf(*everyPoint, world, frame);
  float error = 0, light = 0;
  int seen = 0;
  for (const DeepTile& tile : frame.tiles)
    for (const ShadePoints& batch : tile.batches)
      for (int i = 0; i < batch.count(); ++i) {
        const vec3 P = batch.position(i);
        if (!(P.y < -0.999f && P.x > 0.2f && P.x < 0.9f && P.z > 2.62f && P.z < 3)) continue;
        const size_t pixel = batch.key(i) / 10000 * 64 + batch.key(i) % 10000;
        error += std::abs(luminance(E[pixel]) - luminance(truth[pixel]));
        light += luminance(truth[pixel]);
        ++seen;
      }
  EXPECT_GT(seen, 5);
  EXPECT_LT(error / light, 0.25f);
}

TEST(OccluderSearch, NoRayLooksForSheetsNearerThanWhatRaysTakeForTheSurface) {
  for (const float bound : {0.0f, 0.1f}) {
    SceneBuilder b;
    b.quad({-1, -1, 2}, {1, -1, 2}, {1, -1, 4}, {-1, -1, 4}, vec3(0.7f));
    b.quad({-0.5f, -0.97f, 2}, {0.5f, -0.97f, 2}, {0.5f, -0.97f, 4}, {-0.5f, -0.97f, 4}, vec3(0.7f));
    for (Object& o : b.scene.objects) {
      auto attributes = std::make_shared<Attributes>(*o.attributes);
      attributes->displacement = std::make_shared<ShaderCall>(call("noisybump", {}));
      attributes->displacementBound = bound;  // which rays do not see
      o.attributes = attributes;
    }
    World world(b.scene);
    GatherSettings settings;
    OccluderSearch search(world.rays, settings);
    EXPECT_EQ(search.isUnderOccluder({0, {0, -1, 3}, {0, 1, 0}, 7, 0.04f, 0.01f}, kInfinity, kInfinity), bound == 0);
    EXPECT_FALSE(search.isUnderOccluder({0, {0.8f, -1, 3}, {0, 1, 0}, 7, 0.04f, 0.01f}, kInfinity, kInfinity));
    EXPECT_FALSE(search.isUnderOccluder({0, {0, -1, 3}, {0, 1, 0}, 7, 0.04f, 0.01f}, 0.03f, 0.03f))
        << "records have met it";
    EXPECT_EQ(search.isUnderOccluder({0, {0.49f, -1, 3}, {0, 1, 0}, 7, 0.04f, 0.01f}, 0.02f, kInfinity), bound == 0)
        << "records have met its edge";
    EXPECT_FALSE(search.isUnderOccluder({0, {0.51f, -1, 3}, {0, 1, 0}, 7, 0.04f, 0.01f}, 0.02f, kInfinity));
    if (bound == 0)
      EXPECT_GE(search.raysTraced(), 1 + 2 + 2 + 1 + 1);
    else
      EXPECT_EQ(search.raysTraced(), 0);
  }
}

TEST(GatherPass, ASmallerMaxErrorTakesMoreRecords) {
  int64_t last = 0;
  for (const float maxError : {2.0f, 1.0f, 0.5f}) {
    World world(cornell(indirect(16)).scene);
    const auto services = world.use({.maxError = maxError});
    gatherFrame(*services, frameOf(world, 16));
    EXPECT_GT(world.stats.irradianceCache.samples, last * 5 / 4) << maxError;
    last = world.stats.irradianceCache.samples;
  }
}

TEST(GatherPass, TheHessiansOwnRadiusGrowsWithTheFourthRootOfMaxErrorAndItsFloorWithTheSquare) {
  World world(cornell(indirect(16)).scene);
  const auto byHessian = [&](float maxError) {
    const GatherSettings settings{.samples = 600, .curvature = true, .maxError = maxError};
    const IrradianceRecord r =
        gather(world.rays, world.shading, {0, {0.3f, -1, 3}, {0, 1, 0}, 7, 0.01f, 0.01f}, settings, {}, world.stats);
    return maxError / (1 / r.smoothRadius - 1 / r.closest);
  };
  EXPECT_NEAR(byHessian(16) / byHessian(1), 2, 1e-3f);
  EXPECT_NEAR(byHessian(1.0f / 16) / byHessian(1), 0.5f, 1e-3f);

  const auto planned = [&](float maxError) {
    const auto services = world.use({.maxError = maxError, .errorFunction = ErrorFunction::Hessian});
    gatherFrame(*services, frameOf(world, 64));
    return services->caches().at(0).key;
  };
  for (const float maxError : {0.5f, 4.0f}) {
    const CacheSettings &some = planned(maxError).cache, &one = planned(1).cache;
    EXPECT_NEAR(some.minPixels / some.kappa, maxError * maxError * one.minPixels / one.kappa, 1e-4f);
    EXPECT_NEAR(some.minWeight, maxError > 1 ? one.minWeight / maxError : one.minWeight, 1e-6f) << "so fewer overlap";
    EXPECT_EQ(planned(maxError).gather.maxError, maxError);
  }
}

TEST(GatherPass, AMaxErrorOfZeroGathersEveryPointWhileShading) {
  World world(cornell(indirect(16), 16).scene);
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({.maxError = 0});
  gatherFrame(*services, frame);
  EXPECT_EQ(world.stats.irradianceCache.samples, 0);
  indirectOf(*services, world, frame);
  int64_t points = 0;
  for (const DeepTile& tile : frame.tiles) points += static_cast<int64_t>(tile.fragments.size());
  const HemisphereCells cells = hemisphereCells(16);
  EXPECT_GE(world.stats.rays.gather, points * cells.rings * cells.sectors);
  EXPECT_LE(world.stats.rays.gather, points * cells.rings * cells.sectors * 3 / 2);
}

TEST(GatherPass, InterpolatedLightAgreesWithTheReference) {
  World world(cornell(indirect(256)).scene);
  const DeepFrame frame = frameOf(world, 16);
  auto services = world.use({.maxError = 0.5f});
  gatherFrame(*services, frame);
  const std::vector<vec3> cached = indirectOf(*services, world, frame);
  services = world.use({.mode = GiMode::Reference, .samples = 64, .seed = 7});
  const std::vector<vec3> truth = indirectOf(*services, world, frame);
  vec3 meanCached(0), meanTruth(0);
  for (const vec3& E : cached) meanCached += E;
  for (const vec3& E : truth) meanTruth += E;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(meanCached[c] / meanTruth[c], 1, 0.02f) << c;
  // Block means, so that the noise of the reference does not hide a bias: 8 x 8 pixels of 64 paths.
  double error = 0;
  for (size_t block = 0; block < 64; ++block) {
    float a = 0, b = 0;
    for (size_t k = 0; k < 64; ++k) {
      const size_t i = (block / 8 * 8 + k / 8) * 64 + block % 8 * 8 + k % 8;
      a += cached[i].y;
      b += truth[i].y;
    }
    if (b > 0) error += std::abs(a / b - 1) / 64;
  }
  EXPECT_LT(error, 0.05);
}

// Four corners of one facet, far apart, in one bucket that sees all of the frame; `pixels` pixels see the
// facet.
DeepFrame frameOfOneFacet(const World& world, size_t pixels) {
  DeepFrame frame = frameOf(world, 64);
  DeepTile& tile = frame.tiles[0];
  const auto backWall = std::find_if(tile.facets.begin(), tile.facets.end(), [&](const Facet& f) {
    return tile.batches[static_cast<size_t>(f.batch)].position(f.point[0]).z > 4.19f;
  });
  const int last = tile.batches[static_cast<size_t>(backWall->batch)].count() - 1;
  const Facet facet{backWall->batch, {0, last / 3, last * 2 / 3, last}};
  tile.facets = {facet};
  tile.fragments = {Fragment{0, 4.2f, 1}};
  for (size_t i = 0; i < tile.pixels.size(); ++i) tile.pixels[i] = {0, i < pixels ? 1U : 0U};
  return frame;
}

TEST(GatherPass, EveryCornerOfASmoothShadedFacetIsCoveredOnce) {
  for (const size_t pixels : {1, 100}) {
    World world(cornell(indirect(16)).scene);
    gatherFrame(*world.use({}), frameOfOneFacet(world, pixels));
    EXPECT_EQ(world.stats.irradianceCache.samples, 4) << pixels;
  }
}

TEST(GatherPass, HoldoutsAndSurfacesThatDoNotReceiveAreLeftOut) {
  for (const bool matte : {true, false}) {
    Scene scene = cornell(indirect(16)).scene;
    for (Object& o : scene.objects) {
      auto attributes = std::make_shared<Attributes>(*o.attributes);
      attributes->matte = matte;
      attributes->indirect.receive = matte;
      o.attributes = attributes;
    }
    World world(scene);
    gatherFrame(*world.use({}), frameOf(world, 16));
    EXPECT_EQ(world.stats.irradianceCache.samples, 0);
  }
}

TEST(GatherPass, AttributesOverrideTheLight) {
  Scene scene = cornell(indirect(16)).scene;
  int64_t samples[2];
  for (const int tight : {0, 1}) {
    for (Object& o : scene.objects) {
      auto attributes = std::make_shared<Attributes>(*o.attributes);
      if (tight) attributes->irradianceMaxPixelDist = 2.0f;
      o.attributes = attributes;
    }
    World world(scene);
    gatherFrame(*world.use({}), frameOf(world, 16));
    samples[tight] = world.stats.irradianceCache.samples;
  }
  EXPECT_GT(samples[1], 5 * samples[0] / 4);
}

TEST(GatherPass, ReportsProgressAndStopsWhenAsked) {
  World world(cornell(indirect(16)).scene);
  const DeepFrame frame = frameOf(world, 16);
  std::vector<float> heard;
  auto services = world.use({});
  services->gatherPass(frame, readerOf(frame), [&](float f) { heard.push_back(f); }, {});
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_EQ(heard.back(), 1);
  std::vector<int> strides;
  world.use({})->gatherPass(frame, readerOf(frame), {}, {}, [&](int stride) { strides.push_back(stride); });
  EXPECT_EQ(strides, (std::vector<int>{16, 8, 4, 2}));

  const int64_t before = world.stats.irradianceCache.samples;
  const std::atomic<bool> stop{true};
  world.use({})->gatherPass(frame, readerOf(frame), {}, stop);
  EXPECT_EQ(world.stats.irradianceCache.samples, before);
}

TEST(GatherPass, AnEmptyOrInterruptedFrameIsNoTrouble) {
  World world(cornell(indirect(16)).scene);
  DeepFrame frame = frameOf(world, 16);
  for (DeepTile& tile : frame.tiles) tile = {};
  gatherFrame(*world.use({}), frame);
  gatherFrame(*world.use({}), DeepFrame{});
  EXPECT_EQ(world.stats.irradianceCache.samples, 0);
}

}  // namespace
}  // namespace tomales
