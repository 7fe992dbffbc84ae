// The share of each group of lights in irradiance: shares add up to the whole, and follow gains.
#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;

const std::vector<std::string> kGroups{"", "left", "right"};

vec3 someVector(uint32_t i, uint32_t salt) {
  return {unitFloat(hashCombine(i, salt, 0)), unitFloat(hashCombine(i, salt, 1)), unitFloat(hashCombine(i, salt, 2))};
}

IrradianceExpansion someShare(uint32_t name) {
  IrradianceExpansion share{.E = someVector(name, 0)};
  for (uint32_t c = 0; c < 3; ++c) {
    share.rotationGradient[c] = someVector(name, 1 + c) - 0.5f;
    share.translationGradient[c] = 9.0f * (someVector(name, 4 + c) - 0.5f);
    share.hessian[c] = 30.0f * (someVector(name, 7 + c) - 0.5f);
  }
  return share;
}

/// Records on a plane whose light is the sum of their shares, some of it too steep to be extrapolated.
IrradianceCache plane(ErrorFunction function) {
  const ErrorFunctionInfo& info = infoOf(function);
  IrradianceCache cache({vec3(-1), vec3(1)}, {function, info.kappa, info.maxPixels, info.minPixels, info.minWeight});
  for (uint32_t i = 0; i < 200; ++i) {
    IrradianceRecord r{};
    r.position = {2 * unitFloat(hashCombine(i, 11u)) - 1, 2 * unitFloat(hashCombine(i, 12u)) - 1, 0};
    r.normal = {0, 0, 1};
    r.tangent = {1, 0, 0};
    for (vec3& d : r.dominant) d = r.normal;
    r.harmonicMean = r.closest = 0.5f;
    r.smoothRadius = 0.4f;
    r.pixelSize = 0.02f;
    r.noise = 0.3f;
    IrradianceExpansion all;
    for (uint32_t g = 0; g < 3; ++g) {
      r.shares.push_back(someShare(3 * i + g));
      all.add(r.shares.back(), vec3(1));
    }
    r.light = all;
    cache.insert(r);
  }
  return cache;
}

std::vector<IrradiancePlace> places() {
  std::vector<IrradiancePlace> out;
  for (uint32_t i = 0; i < 300; ++i) {
    const vec3 n = normalizeOr(vec3(0.1f * unitFloat(hashCombine(i, 21u)), 0, 1), vec3(0));
    out.push_back({{unitFloat(hashCombine(i, 22u)), unitFloat(hashCombine(i, 23u)), 0}, n, n, 0.02f});
  }
  return out;
}

class Shares : public testing::TestWithParam<ErrorFunction> {};

TEST_P(Shares, AddUpToTheWholeAndFollowGains) {
  const IrradianceCache cache = plane(GetParam());
  const std::vector<IrradiancePlace> at = places();
  const auto ask = [&](const std::vector<vec3>& gains) {
    std::vector<IrradianceEstimate> out(at.size());
    const std::vector<IrradianceExpansion> light =
        gains.empty() ? std::vector<IrradianceExpansion>() : cache.mixed(gains);
    cache.lookup(at, out.data(), 1.25f, light);
    return out;
  };
  const vec3 red(2, 0, 0.5f);
  const auto whole = ask({}), same = ask({vec3(1), vec3(1), vec3(1)}), second = ask({vec3(0), vec3(1), vec3(0)}),
             mixed = ask({vec3(1), red, vec3(1)});
  int served = 0;
  for (size_t i = 0; i < at.size(); ++i) {
    served += whole[i].weight > 0;
    EXPECT_EQ(mixed[i].weight, whole[i].weight) << "gains do not change where a record is used";
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(same[i].E[c], whole[i].E[c], 1e-4f);
      EXPECT_NEAR(mixed[i].E[c], same[i].E[c] + (red[c] - 1) * second[i].E[c], 1e-4f);
      EXPECT_EQ(mixed[i].dominant[c], whole[i].dominant[c]);
    }
  }
  EXPECT_GT(served, 50);
}

TEST(CachedMix, IsThatOfTheGainsAskedForAndOfEveryRecord) {
  IrradianceCache cache = plane(ErrorFunction::Screen);
  const std::vector<vec3> second{vec3(0), vec3(1), vec3(0)}, red{vec3(1), vec3(2, 0, 0.5f), vec3(1)};
  const auto isMixed = [&](const std::vector<vec3>& gains) {
    const std::vector<IrradianceExpansion> fresh = cache.mixed(gains);
    const std::span<const IrradianceExpansion> kept = cache.cachedMix(gains);
    return std::ranges::equal(kept, fresh, {}, &IrradianceExpansion::E, &IrradianceExpansion::E);
  };
  EXPECT_TRUE(isMixed(second));
  const IrradianceExpansion* place = cache.cachedMix(second).data();
  EXPECT_EQ(cache.cachedMix(second).data(), place);
  EXPECT_TRUE(isMixed(red));
  const IrradianceRecord more = cache.records()[0];
  cache.restore(more);
  EXPECT_TRUE(isMixed(red));
}

INSTANTIATE_TEST_SUITE_P(OfAllErrorFunctions, Shares,
                         testing::Values(ErrorFunction::Screen, ErrorFunction::Ward, ErrorFunction::Hessian));

/// A room with two lamps of other colours and a light that every bounce keeps going.
SceneBuilder room() {
  SceneBuilder b = cornell({floatParam("bounces", 3)});
  b.scene.lights.front()->handle = "left";
  b.light("pointlight", {floatParam("intensity", 0.4f), pointParam("from", {-0.5f, -0.2f, 2.6f})});
  b.scene.lights.back()->handle = "right";
  for (Object& o : b.scene.objects) {
    auto attributes = std::make_shared<Attributes>(*o.attributes);
    attributes->lights.switchOn(2);
    o.attributes = attributes;
  }
  return b;
}

IrradianceRecord gatherIn(SceneBuilder b, std::span<const std::string> groups) {
  World world(std::move(b.scene));
  const auto services = world.use({.mode = GiMode::Gather, .bounces = 3});
  GatherSettings settings{.samples = 400};
  settings.indirect = true;
  return gather(world.rays, world.shading, {0, {0.2f, -1, 3}, {0, 1, 0}, 7, 0.01f, 0.01f}, settings, {}, world.stats,
                nullptr, groups);
}

TEST(SharesOfARecord, AreThoseOfItsLightsWithAllThatTheyBounce) {
  const IrradianceRecord record = gatherIn(room(), kGroups);
  ASSERT_EQ(record.shares.size(), 3u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(record.shares[0].E[c], 0) << "nothing shines by itself";
    EXPECT_NEAR((record.shares[1].E + record.shares[2].E)[c], record.light.E[c], 1e-4f * record.light.E[c]);
    const vec3 gradient = record.shares[1].translationGradient[c] + record.shares[2].translationGradient[c];
    EXPECT_LT(glm::distance(gradient, record.light.translationGradient[c]), 1e-3f);
  }
  SceneBuilder brighter = room();
  brighter.scene.lights.back()->shader.params[0].floats[0] *= 3;
  const IrradianceRecord truth = gatherIn(std::move(brighter), {});
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR((record.shares[1].E + 3.0f * record.shares[2].E)[c], truth.light.E[c], 1e-3f * truth.light.E[c]);
  EXPECT_GT(luminance(record.shares[2].E), 0.1f * luminance(record.light.E));
}

TEST(SharesOfARecord, LeaveTheRecordAsItIs) {
  const IrradianceRecord with = gatherIn(room(), kGroups), without = gatherIn(room(), {});
  EXPECT_EQ(with.light.E, without.light.E);
  EXPECT_EQ(with.light.translationGradient[1], without.light.translationGradient[1]);
  EXPECT_EQ(with.noise, without.noise);
}

// The coarse picture of tomales relight asks at the same points again and again.
TEST(RecordedLookups, SayWhatTheCacheSaysUnderTheSameGainsWithoutAskingIt) {
  World world(room().scene);
  const auto services = world.use({.mode = GiMode::Gather, .samples = 32});
  services->keepShares(kGroups);
  const DeepFrame frame = frameOf(world, 16);
  gatherFrame(*services, frame);
  const ShadePoints& batch = frame.tiles[5].batches[0];
  const IndirectQuery query = *world.shading.group(batch.group()).indirectQuery();
  RayAnswers answers;
  answers.recording = answers.recordsStay = true;
  ShadeContext context;
  context.answers = &answers;
  const auto lookups = [&] { return int64_t{world.stats.irradianceCache.lookups}; };
  std::vector<std::vector<vec3>> seen;
  for (const std::vector<vec3>& gains : {std::vector<vec3>{}, {vec3(0), vec3(1), vec3(0)}, {vec3(0), vec3(0), vec3(1)}})
    for (const bool isFirst : {true, false}) {
      services->mixShares(gains);
      const std::vector<vec3> truth = indirectAt(*services, batch, query);
      const int64_t before = lookups();
      EXPECT_EQ(indirectAt(*services, batch, query, context), truth);
      EXPECT_EQ(lookups(), isFirst ? before + batch.count() : before);
      if (isFirst) seen.push_back(truth);
    }
  EXPECT_NE(seen[1], seen[2]);
  answers.recordsStay = false;
  const int64_t before = lookups();
  EXPECT_EQ(indirectAt(*services, batch, query, context), seen[2]);
  EXPECT_EQ(lookups(), before + batch.count());
}

}  // namespace
}  // namespace tomales
