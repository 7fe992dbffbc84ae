// Rays that leave the micropolygons of a surface against its coarse polygons: what the hit list is for.
#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "reyes/dice.h"
#include "world.h"

namespace tomales::test {
namespace {

/// A ray that leaves a closed surface outwards meets its inside only if the coarse polygons pretend it
/// started there.
struct Counts {
  int rays = 0, insideHits = 0, adjusted = 0;
};

Counts leaveOutwards(const World& world, float leastCosine) {
  Counts counts;
  Grid g = diceAtOpen(world.scene, 0, 0, UvRect{0.013f, 0.987f, 0.1f, 0.9f}, 90, 60);
  world.shading->displace(g);
  std::vector<float> n[3] = {std::vector<float>(static_cast<size_t>(g.stride())), {}, {}};
  n[1] = n[2] = n[0];
  calculateNormals(g, world.scene.objects[0].flipsNormal, n[0].data(), n[1].data(), n[2].data());
  for (int i = 0; i < g.vertexCount(); ++i) {
    const auto k = static_cast<size_t>(i);
    const vec3 N(n[0][k], n[1][k], n[2][k]);
    vec3 x, y;
    orthonormalBasis(N, x, y);
    for (uint32_t s = 0; s < 16; ++s) {
      const vec3 d = cosineHemisphere(sobol2(s, static_cast<uint32_t>(i)));
      if (d.z < leastCosine) continue;
      const Ray ray = world.rayFrom(0, g.position(0, i), d.x * x + d.y * y + d.z * N);
      const Hit hit = world.rays->closest(ray, kMaskDiffuse);
      ++counts.rays;
      counts.insideHits += hit.object == 0 && dot(ray.direction, hit.geometricNormal) > 0;
      counts.adjusted += hit.adjusted;
    }
  }
  return counts;
}

/// The sphere has radius 1, lies five units away, and has lumps of up to 0.05.
struct BumpySphere : World {
  BumpySphere(bool hitList, bool displacedRays) {
    attributes.trace.displacements = displacedRays;
    attributes.displacement = shader("noisybump", {floatsParam("Km", ValueType::Float, Storage::Uniform, {0.05f}),
                                                   floatsParam("frequency", ValueType::Float, Storage::Uniform, {3})});
    attributes.displacementBound = 0.05f;
    add(sphere(), translation({0, 0, 5}));
    build({hitList});
  }
};

// Figures of docs/measured/rays.md.
TEST(SelfHit, WithoutTheHitListManyRaysMeetTheSurfaceThatTheyLeave) {
  const BumpySphere world(false, false);
  const Counts counts = leaveOutwards(world, 0);
  EXPECT_GT(counts.insideHits, counts.rays / 10);
  EXPECT_EQ(counts.adjusted, 0);
}

TEST(SelfHit, WithTheHitListNoRayWithin45DegreesOfTheNormalDoes) {
  const BumpySphere world(true, false);
  const Counts counts = leaveOutwards(world, std::sqrt(0.5f));
  EXPECT_GT(counts.rays, 10000);
  EXPECT_EQ(counts.insideHits, 0);
  EXPECT_GT(counts.adjusted, counts.rays * 9 / 10);
}

// What remains are grazing rays that cross a lump which the coarse surface does not have.
TEST(SelfHit, OfAllRaysOfTheHemisphereThreeInAThousandDo) {
  const BumpySphere world(true, false);
  const Counts counts = leaveOutwards(world, 0);
  EXPECT_LT(counts.insideHits * 1000, counts.rays * 3);
}

TEST(SelfHit, DisplacedCoarsePolygonsNeedLessOffset) {
  const BumpySphere plain(true, false), displaced(true, true);
  const vec3 P(0, 0, 4), away(0, 0, -1);
  EXPECT_LT(displaced.rayFrom(0, P, away).offset, 0.7f * plain.rayFrom(0, P, away).offset);
  const Counts counts = leaveOutwards(displaced, 0);
  EXPECT_LT(counts.insideHits * 1000, counts.rays * 3);
}

}  // namespace
}  // namespace tomales::test
