// Compares the part of a hemisphere that disks hide with form factors.
#include "gi/clouds/disks.h"

#include <gtest/gtest.h>

namespace tomales {
namespace {

/// A cloud of points that a function places, with what their fronts send.
PointCloud cloudOf(int count, float radius, const std::function<void(int i, vec3& P, vec3& N, vec3& light)>& place) {
  PointCloud cloud;
  cloud.channels = {{"_radiosity", 3}};
  for (int i = 0; i < count; ++i) {
    vec3 P, N, light(0);
    place(i, P, N, light);
    cloud.add(P, N, radius, &light.x);
  }
  return cloud;
}

/// Points evenly over a unit sphere around `center`, on a spiral.
PointCloud sphere(int count, const vec3& center) {
  return cloudOf(count, std::sqrt(2 * kPi / static_cast<float>(count)), [&](int i, vec3& P, vec3& N, vec3& light) {
    const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count), r = std::sqrt(1 - z * z),
                phi = 2.39996f * static_cast<float>(i);
    N = {r * std::cos(phi), r * std::sin(phi), z};
    P = center + N;
    light = {2, 1, 0};
  });
}
/// The plane x = 1 from -size to size, facing -x.
PointCloud wall(int n, float size) {
  const float step = 2 * size / static_cast<float>(n);
  return cloudOf(n * n, step / std::sqrt(2.0f), [&](int i, vec3& P, vec3& N, vec3& light) {
    P = {1, -size + (static_cast<float>(i % n) + 0.5f) * step, -size + (static_cast<float>(i / n) + 0.5f) * step};
    N = {-1, 0, 0};
    light = {0, 3, 0};
  });
}
const vec3 kAxis{0, 0, 1};

TEST(Disks, ASphereHidesItsFormFactorAndSendsThatMuchLight) {
  for (const float height : {1.5f, 3.0f, 8.0f})
    for (const float tilt : {0.0f, 0.5f}) {
      const Disks disks(sphere(5000, height * vec3(std::sin(tilt), 0, std::cos(tilt))), "_radiosity");
      const float truth = std::cos(tilt) / (height * height);  // of a sphere that is wholly above the horizon
      const HemisphereView seen = disks.seenFrom(vec3(0), kAxis, {});
      EXPECT_NEAR(seen.covered, truth, 0.03f * truth + 0.005f) << height << " " << tilt;
      EXPECT_NEAR(seen.radiance.x, 2 * truth, 0.06f * truth + 0.01f) << "fronts alone shine, and only they are seen";
      EXPECT_NEAR(seen.radiance.y, truth, 0.03f * truth + 0.005f);
    }
}

TEST(Disks, AWallHidesHalfAndTheFloorBelowNothing) {
  const Disks disks(wall(300, 60), "_radiosity");
  EXPECT_NEAR(disks.seenFrom(vec3(0), kAxis, {}).covered, 0.5f, 0.02f);
  EXPECT_EQ(disks.seenFrom(vec3(0), {-1, 0, 0}, {}).covered, 0);
  EXPECT_EQ(disks.seenFrom({1, 0.03f, 0.07f}, {-1, 0, 0}, {}).covered, 0) << "a point of the wall itself";
  EXPECT_NEAR(disks.seenFrom(vec3(0), {1, 0, 0}, {}).covered, 1, 0.02f);
}

TEST(Disks, WhatIsBehindCountsUnlessClamped) {
  PointCloud both = wall(100, 20);
  const PointCloud first = both;
  for (size_t i = 0; i < first.count(); ++i) {
    const float light[] = {7, 0, 0};
    both.add(first.position[i] + vec3(1, 0, 0), first.normal[i], first.radius[i], light);
  }
  const Disks disks(both, "_radiosity");
  DisksQuery query;
  const vec3 clamped = disks.seenFrom(vec3(0), kAxis, query).radiance;
  EXPECT_LT(clamped.x, 0.1f) << "what is behind the wall";
  EXPECT_NEAR(clamped.y, 3 * 0.48f, 0.1f);
  query.clamp = false;
  const vec3 all = disks.seenFrom(vec3(0), kAxis, query).radiance;
  EXPECT_NEAR(all.x, 7 * 0.46f, 0.3f);
  EXPECT_NEAR(all.y, 3 * 0.48f, 0.1f);
}

TEST(Disks, SidesDistancesConesAndFalloffAreObeyed) {
  const Disks disks(wall(300, 60), "");
  const auto covered = [&](const DisksQuery& q) { return disks.seenFrom(vec3(0), {1, 0, 0}, q).covered; };
  DisksQuery query;
  query.falloff.sides = HitSides::Front;
  EXPECT_NEAR(covered(query), 1, 0.02f);
  query.falloff.sides = HitSides::Back;
  EXPECT_NEAR(covered(query), 0, 0.02f);
  query = {};
  query.falloff.maxDistance = 2;  // to 60 degrees from the normal
  EXPECT_NEAR(covered(query), 0.75f, 0.03f);
  query.falloff.falloffMode = 1;
  query.falloff.falloff = 1;  // the mean of 1 - 1 / (2 cos) there, by the cosine: 3/4 - 1/2
  EXPECT_NEAR(covered(query), 0.25f, 0.03f);
  query = {};
  query.coneAngle = 0.5f;
  query.falloff.maxDistance = 1.2f;
  EXPECT_NEAR(covered(query), 1, 0.02f);
}

TEST(Disks, CoarserIsNearlyTheSame) {
  const Disks disks(sphere(20000, {0, 0, 2}), "_radiosity");
  DisksQuery coarse, fine;
  coarse.maxSolidAngle = 0.01f;
  fine.maxSolidAngle = 0.0005f;
  EXPECT_NEAR(disks.seenFrom(vec3(0), kAxis, coarse).covered, disks.seenFrom(vec3(0), kAxis, fine).covered, 0.02f);
}

TEST(Disks, ANarrowConeSeesWhatItHolds) {
  const Disks disks(wall(300, 3), "_radiosity");
  DisksQuery query;
  query.coneAngle = 0.02f;
  EXPECT_NEAR(disks.seenFrom(vec3(0), {1, 0, 0}, query).covered, 1, 1e-4f);
  // Along the edge of the wall: half of the cone.
  const HemisphereView half = disks.seenFrom(vec3(0), glm::normalize(vec3(1, 3, 0)), query);
  EXPECT_NEAR(half.covered, 0.5f, 0.06f);
  EXPECT_NEAR(half.radiance.y, 3 * half.covered, 1e-3f);
}

TEST(Disks, AMicropolygonThatSpansABallDoesNotSeeTheBallFromWithin) {
  const Disks disks(sphere(20000, {0, 0, 0}), "_radiosity");
  const float radius = 0.2f, depth = radius * radius / 2;
  const vec3 middle(0, 0, 1 - depth);
  EXPECT_GT(disks.seenFrom(middle, kAxis, {}).covered, 0.9f) << "a point there does";
  EXPECT_LT(disks.seenFrom(middle, kAxis, {}, radius).covered, 0.02f);
  const Disks beside(wall(300, 60), "_radiosity");
  EXPECT_NEAR(beside.seenFrom(vec3(0), kAxis, {}, radius).covered, 0.5f, 0.02f) << "it sees what is farther away";
  DisksQuery query;
  query.falloff.bias = 0.001f;
  EXPECT_GT(disks.seenFrom(middle, kAxis, query, radius).covered, 0.9f) << "a bias that is given holds";
}

TEST(Disks, LargeOnesBesideASmallMicropolygonAreCoarse) {
  const Disks disks(wall(10, 1), "_radiosity");  // of radius 0.14
  const vec3 near(0.9f, 0, 0), forward(1, 0, 0);
  EXPECT_GT(disks.seenFrom(near, forward, {}, 0.02f).coarse, 0.3f);
  EXPECT_EQ(disks.seenFrom(near, forward, {}, 0.1f).coarse, 0) << "beside one that is about as large";
  EXPECT_EQ(disks.seenFrom({0.5f, 0, 0}, forward, {}, 0.02f).coarse, 0) << "from farther away";
}

TEST(Disks, WithoutTheChannelNothingIsSent) {
  EXPECT_FALSE(Disks(wall(2, 1), "_colour").sends());
  EXPECT_TRUE(Disks(wall(2, 1), "_radiosity").sends());
  EXPECT_EQ(Disks(PointCloud{}, "").seenFrom(vec3(0), kAxis, {}).covered, 0);
}

}  // namespace
}  // namespace tomales
