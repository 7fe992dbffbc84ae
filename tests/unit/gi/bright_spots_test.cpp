#include "gi/cache/bright_spots.h"

#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;

BrightFind disk(const vec3& center, float radius, int hits, float radiance) {
  BrightFind find{1, {}};
  for (int i = 0; i < hits; ++i) {
    const vec2 xi = sobol2(static_cast<uint32_t>(i), 7);
    const float r = radius * std::sqrt(xi.x), phi = 2 * kPi * xi.y;
    find.hits.push_back({center + vec3(r * std::cos(phi), r * std::sin(phi), 0), radiance, {0, 0, -1}});
  }
  return find;
}

BrightSpots twoDisks() {
  BrightSpots spots;
  spots.learn({disk({0, 0, 5}, 0.2f, 300, 50), disk({3, 0, 4}, 0.1f, 300, 20)});
  return spots;
}

TEST(BrightSpots, HoldAllThatWasFoundAndLittleElse) {
  const BrightSpots spots = twoDisks();
  ASSERT_FALSE(spots.spots().empty());
  for (const BrightFind& find : {disk({0, 0, 5}, 0.2f, 300, 50), disk({3, 0, 4}, 0.1f, 300, 20)})
    for (const BrightHit& hit : find.hits)
      EXPECT_TRUE(std::any_of(spots.spots().begin(), spots.spots().end(), [&](const BrightSpots::Spot& s) {
        return glm::length(hit.position - s.center) <= s.radius;
      }));
  for (const BrightSpots::Spot& s : spots.spots()) EXPECT_LT(s.radius, 0.25f);
}

TEST(BrightSpots, WhatIsFlatIsARectangleAndNoSphere) {
  const BrightSpots disks = twoDisks();
  for (const BrightSpots::Spot& s : disks.spots()) {
    EXPECT_EQ(s.normal, vec3(0, 0, -1));
    EXPECT_NEAR(glm::length(s.halfU + s.halfV), s.radius, 1e-6f);
    EXPECT_NEAR(dot(s.halfU, s.halfV), 0, 1e-6f);
  }
  BrightFind ball = disk({0, 0, 5}, 0.2f, 300, 50);
  for (BrightHit& hit : ball.hits) hit.normal = normalizeOr(hit.position - vec3(0, 0, 5.02f), {0, 0, -1});
  BrightSpots spots;
  spots.learn({ball});
  EXPECT_TRUE(std::any_of(spots.spots().begin(), spots.spots().end(),
                          [](const BrightSpots::Spot& s) { return s.normal == vec3(0); }));
}

TEST(SpotAim, ARectangleSeenFromTheSideIsAimedAtAsNarrowlyAsItLooks) {
  const SpotAim aim(twoDisks(), {5, 0, 4.9f},
                    normalizeOr({-1, 0, 0.01f}, {}));  // 0.1 above the plane of the first, at 25 radii
  ASSERT_GT(aim.irradiance(), 0);
  for (uint32_t i = 0; i < 256; ++i) {
    const vec3 d = aim.direction(sobol1(i, 1), sobol2(i, 2));
    const vec3 onPlane = vec3(5, 0, 4.9f) + d * (0.1f / d.z);
    EXPECT_GT(d.z, 0);
    EXPECT_LT(glm::length(onPlane - vec3(0, 0, 5)), 0.5f);
  }
}

TEST(SpotAim, WhatIsHiddenIsAimedAtLess) {
  SpotAim aim(twoDisks(), vec3(0), {0, 0, 1});
  ASSERT_GT(aim.targets(), 1u);
  const float all = aim.irradiance();
  std::vector<float> shares(aim.targets(), 0.05f);  // all but the target straight ahead are dimmed
  float left = 0;
  for (size_t t = 0; t < aim.targets(); ++t)
    if (aim.probe(t, {0.5f, 0.5f}).x < 0.1f) shares[t] = 1;
  aim.dim(shares);
  for (uint32_t i = 0; i < 1024; ++i)
    left += aim.direction((static_cast<float>(i) + 0.5f) / 1024, sobol2(i, 2)).x < 0.2f ? 1.0f / 1024 : 0.0f;
  EXPECT_LT(aim.irradiance(), all);
  EXPECT_GT(left, 0.95f);  // undimmed, the other target has a fifth of the light
}

TEST(Gather, SpotsBehindAScreenTakeNoRaysFromWhatCanBeSeen) {
  // The nearer and larger of two glows is behind a screen, so the noise is that of the other one, which rays aim at.
  SceneBuilder b;
  b.light("distantlight", {pointParam("from", {0, 0, 0}), pointParam("to", {0, 0, 1})});
  b.quad({-0.15f, 1.75f, 5}, {0.15f, 1.75f, 5}, {0.15f, 2.05f, 5}, {-0.15f, 2.05f, 5}, vec3(0.8f));
  b.quad({0.8f, 0.6f, 3}, {1.2f, 0.6f, 3}, {1.2f, 1, 3}, {0.8f, 1, 3}, vec3(0.8f));
  b.quad({0.5f, -2, 2.5f}, {0.5f, 2, 2.5f}, {0.7f, 2, 1}, {0.7f, -2, 1}, vec3(0));
  World world(b.scene);
  std::vector<BrightFind> found(1);
  found[0].irradiance = 1e-3f;
  for (int i = 0; i < 400; ++i) {
    const vec2 xi = sobol2(static_cast<uint32_t>(i), 7);
    found[0].hits.push_back({{-0.15f + 0.3f * xi.x, 1.75f + 0.3f * xi.y, 5}, 0.25f, {0, 0, -1}});
    found[0].hits.push_back({{0.8f + 0.4f * xi.x, 0.6f + 0.4f * xi.y, 3}, 0.25f, {0, 0, -1}});
  }
  BrightSpots both, visible;
  both.learn(found);
  std::erase_if(found[0].hits, [](const BrightHit& h) { return h.position.x > 0.5f; });
  visible.learn(found);
  const auto noise = [&](const BrightSpots& spots) {
    double sum = 0, squares = 0;
    for (uint32_t i = 0; i < 300; ++i) {
      GatherSettings settings;
      settings.samples = 512;
      const double E = luminance(gather(world.rays, world.shading, {0, {0, -1, 1.5f}, {0, 1, 0}, i, 0.01f, 0.01f},
                                        settings, {&spots}, world.stats)
                                     .light.E);
      sum += E;
      squares += E * E;
    }
    return std::sqrt(std::max(0.0, squares / 300 - sum * sum / 90000)) / (sum / 300);
  };
  EXPECT_LT(noise(both), 1.5 * noise(visible));
}

// A glow 2 wide, a twentieth of the hemisphere of the point below, over a floor.
SceneBuilder floorUnderAGlow() {
  SceneBuilder b;
  b.quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, vec3(0.8f));
  b.light("distantlight", {pointParam("from", {0, 0, 0}), pointParam("to", {0, 0, 1})});
  b.quad({-1, -1, 5}, {1, -1, 5}, {1, 1, 5}, {-1, 1, 5}, vec3(0.8f));
  return b;
}

constexpr GatherPoint kBelow{0, {0, 0, 0}, {0, 0, 1}, 1, 0.01f, 0.01f};

BrightSpots spotsOfTheGlow() {
  BrightSpots spots;
  spots.learn({disk({0, 0, 5}, 1, 300, 0.8f)});
  return spots;
}

TEST(Gather, SpotsThatChanceFindsTakeNoRays) {
  World world(floorUnderAGlow().scene);
  const BrightSpots spots = spotsOfTheGlow(), none;
  for (const int samples : {1000, 8000}) {
    GatherSettings settings;
    settings.samples = samples;
    const auto raysWith = [&](const BrightSpots& known) {
      const int64_t before = world.stats.rays.gather;
      gather(world.rays, world.shading, kBelow, settings, {&known}, world.stats);
      return world.stats.rays.gather - before;
    };
    const int64_t more = raysWith(spots) - raysWith(none);
    EXPECT_EQ(more > 0, samples == 1000) << more;
  }
}

TEST(Gather, LargeSpotsThatAreMostlyHiddenAreAimedAtWhereTheyAreNot) {
  SceneBuilder b = floorUnderAGlow();
  // Before all of the glow but the last 0.08 of 2.
  b.quad({-1, -1, 2.5f}, {0.46f, -1, 2.5f}, {0.46f, 1, 2.5f}, {-1, 1, 2.5f}, vec3(0));
  World world(b.scene);
  const BrightSpots spots = spotsOfTheGlow(), none;
  const auto figures = [&](const BrightSpots& known) {
    double sum = 0, squares = 0;
    constexpr int kCount = 40;
    for (uint32_t i = 0; i < kCount; ++i) {
      GatherSettings settings;
      settings.samples = 8000;
      GatherPoint point = kBelow;
      point.key = i;
      const double E = luminance(gather(world.rays, world.shading, point, settings, {&known}, world.stats).light.E);
      sum += E / kCount;
      squares += E * E / kCount;
    }
    return std::pair(sum, std::sqrt(std::max(0.0, squares - sum * sum)) / sum);
  };
  double truth = 0;
  for (int i = 0; i < 200; ++i) {
    const double y = (i + 0.5) / 100 - 1, square = 25 + 0.96 * 0.96 + y * y;
    truth += 0.8 * 25 / (kPi * square * square) * 0.08 / 100;
  }
  const auto [aimed, noise] = figures(spots);
  EXPECT_NEAR(aimed / truth, 1, 0.04);
  EXPECT_LT(noise, 0.6 * figures(none).second);
}

TEST(BrightSpots, ASingleHitIsChance) {
  BrightSpots spots;
  spots.learn({disk({0, 0, 5}, 0.2f, 1, 50)});
  EXPECT_TRUE(spots.spots().empty());
  EXPECT_EQ(SpotAim(spots, vec3(0), {0, 0, 1}).irradiance(), 0);
}

TEST(SpotAim, LooksPastWhatIsBehindTheSurface) { EXPECT_EQ(SpotAim(twoDisks(), vec3(0), {0, 0, -1}).irradiance(), 0); }

TEST(SpotAim, ItsDensityIsThatOfItsDirections) {
  const SpotAim aim(twoDisks(), vec3(0), {0, 0, 1});
  ASSERT_GT(aim.irradiance(), 0);
  // The mean of 1/density over its directions is the solid angle that they cover, found by uniform directions too.
  constexpr uint32_t kCount = 200000;
  double covered = 0, integral = 0;
  int inside = 0;
  for (uint32_t i = 0; i < kCount; ++i) {
    const vec3 d = aim.direction(sobol1(i, 1), sobol2(i, 2));
    const float density = aim.pdf(d);
    ASSERT_GT(density, 0);
    covered += 1.0 / density / kCount;
    const vec2 xi = sobol2(i, 3);  // over the cone of half angle 45 degrees around +z
    const float z = 1 - xi.x * (1 - std::sqrt(0.5f)), r = std::sqrt(1 - z * z);
    const float uniform = aim.pdf({r * std::cos(2 * kPi * xi.y), r * std::sin(2 * kPi * xi.y), z});
    integral += uniform / kCount;
    inside += uniform > 0;
  }
  const double cone = 2 * kPi * (1 - std::sqrt(0.5));
  EXPECT_NEAR(integral * cone, 1, 0.03);
  EXPECT_NEAR(covered / (inside * cone / kCount), 1, 0.03);
}

// A room lit through a small bright quad far away.
SceneBuilder roomWithAGlow() {
  SceneBuilder b;
  b.light("distantlight", {pointParam("from", {0, 0, 0}), pointParam("to", {0, 0, 1})});
  b.quad({-0.15f, 1.75f, 5}, {0.15f, 1.75f, 5}, {0.15f, 2.05f, 5}, {-0.15f, 2.05f, 5}, vec3(0.8f));
  b.quad({-3, -1, 0}, {3, -1, 0}, {3, -1, 6}, {-3, -1, 6}, vec3(0.1f));
  return b;
}

TEST(Gather, RaysAimedAtABrightSpotKeepTheMeanAndTakeTheNoise) {
  World world(roomWithAGlow().scene);
  GatherSettings settings;
  settings.samples = 4096;
  const GatherPoint from{1, {0.3f, -1, 1}, {0, 1, 0}, 1, 0.01f, 0.01f};
  std::vector<BrightFind> finds(64);
  for (uint32_t i = 0; i < finds.size(); ++i) {
    GatherPoint point = from;
    point.key = 1000 + i;
    point.position.x += 0.01f * static_cast<float>(i);
    gather(world.rays, world.shading, point, settings, {}, world.stats, &finds[i]);
  }
  BrightSpots spots;
  spots.learn(finds);
  ASSERT_FALSE(spots.spots().empty());
  const auto figures = [&](const BrightSpots& aimedAt, int samples, int count) {
    settings.samples = samples;
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
      GatherPoint point = from;
      point.key = static_cast<uint32_t>(i);
      const double E = luminance(gather(world.rays, world.shading, point, settings, {&aimedAt}, world.stats).light.E);
      sum += E;
      squares += E * E;
    }
    const double mean = sum / count;
    return std::pair(mean, std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean);
  };
  const double truth = figures({}, 4096, 64).first;
  const double plainNoise = figures({}, 128, 400).second;
  const auto [aimed, aimedNoise] = figures(spots, 128, 400);
  EXPECT_NEAR(aimed / truth, 1, 0.02);
  EXPECT_LT(aimedNoise, 0.3 * plainNoise);
}

}  // namespace
}  // namespace tomales
