#include <gtest/gtest.h>

#include "raytrace/emitters.h"
#include "reyes/base/rng.h"
#include "world.h"

namespace tomales::test {
namespace {

struct Samples {
  std::vector<vec3> P, N;
  std::vector<float> area;
  double meanArea = 0;
};

Samples sample(const World& world, int light, int count) {
  const auto n = static_cast<size_t>(count);
  std::vector<float> xi0(n), xi1(n), data[6];
  for (auto& d : data) d.resize(n);
  Samples out;
  out.area.resize(n);
  for (size_t i = 0; i < n; ++i) {
    const vec2 xi = sobol2(static_cast<uint32_t>(i), 11);
    xi0[i] = xi.x;
    xi1[i] = xi.y;
  }
  EXPECT_TRUE(world.rays->emitters().sample(light, count, xi0.data(), xi1.data(),
                                            {data[0].data(), data[1].data(), data[2].data()},
                                            {data[3].data(), data[4].data(), data[5].data()}, out.area.data()));
  for (size_t i = 0; i < n; ++i) {
    out.P.emplace_back(data[0][i], data[1][i], data[2][i]);
    out.N.emplace_back(data[3][i], data[4][i], data[5][i]);
    out.meanArea += static_cast<double>(out.area[i]) / count;
  }
  return out;
}

TEST(Emitters, ARectangleIsSampledUniformlyWithItsWholeArea) {
  World world;
  world.attributes.areaLight = world.addAreaLight();
  world.add(parallelogram({-1, 2, 4}, {2, 0, 0}, {0, 0, 3}));
  world.build();
  const Samples s = sample(world, 0, 4096);
  int cells[4][4] = {};
  for (size_t i = 0; i < s.P.size(); ++i) {
    EXPECT_NEAR(s.area[i], 6, 1e-4f);
    EXPECT_NEAR(s.P[i].y, 2, 1e-5f);
    EXPECT_NEAR(s.N[i].y, -1, 1e-5f);
    ++cells[static_cast<int>(std::clamp(2 * (s.P[i].x + 1), 0.0f, 3.0f))]
           [static_cast<int>(std::clamp(4 * (s.P[i].z - 4) / 3, 0.0f, 3.0f))];
  }
  for (const auto& row : cells)
    for (const int count : row) EXPECT_NEAR(count, 256, 2);
}

TEST(Emitters, ObjectsOfOneLightShareItsSamplesByArea) {
  World world;
  world.attributes.areaLight = world.addAreaLight();
  world.add(parallelogram({-1, 2, 4}, {1, 0, 0}, {0, 0, 1}));
  world.attributes.color = vec3(0.5f);
  world.add(parallelogram({5, 2, 4}, {3, 0, 0}, {0, 0, 1}));
  world.build();
  const Samples s = sample(world, 0, 4000);
  EXPECT_NEAR(s.meanArea, 4, 1e-4);
  EXPECT_NEAR(static_cast<double>(std::count_if(s.P.begin(), s.P.end(), [](const vec3& p) { return p.x < 1; })), 1000,
              5);
}

TEST(Emitters, ASphereLightIsSampledOnTheSphereItself) {
  World world;
  world.attributes.areaLight = world.addAreaLight();
  world.add(sphere(0.5f), translation({0, 0, 50}));  // few pixels: the turn of the normal decides
  world.build();
  const Samples s = sample(world, 0, 1 << 14);
  EXPECT_NEAR(s.meanArea / (4 * static_cast<double>(kPi) * 0.25), 1, 2e-4);
  vec3 mean(0);
  double aboveEquator = 0;
  for (size_t i = 0; i < s.P.size(); ++i) {
    EXPECT_NEAR(glm::length(s.P[i] - vec3(0, 0, 50)), 0.5f, 2e-5f);
    EXPECT_GT(dot(s.N[i], glm::normalize(s.P[i] - vec3(0, 0, 50))), 0.9999f);
    mean += s.area[i] * (s.P[i] - vec3(0, 0, 50));
    aboveEquator += s.P[i].z > 50.25f ? static_cast<double>(s.area[i]) : 0.0;
  }
  // Archimedes: a quarter of the sphere's area lies above half its radius.
  EXPECT_NEAR(aboveEquator / (s.meanArea * static_cast<double>(s.P.size())), 0.25, 0.002);
  EXPECT_LT(glm::length(mean) / static_cast<float>(s.P.size()), 0.01f);
}

/// Pieces of a light around the origin: a bent band of trapezia, of which one hides another.
World& trapezia(World& world, int pieces) {
  world.attributes.areaLight = world.addAreaLight();
  for (int i = 0; i < pieces; ++i) {
    const float a = 2 * kPi * static_cast<float>(i) / static_cast<float>(pieces),
                b = a + 3 * kPi / static_cast<float>(pieces);
    const vec3 p(std::cos(a), std::sin(a), 0), q(std::cos(b), std::sin(b), 0), up(0, 0, 1);
    Problems problems;
    std::vector<float> values;
    for (const vec3& c : {q, p, 0.9f * p + 0.3f * (q - p) + up, 0.9f * p + up})
      values.insert(values.end(), {c.x, c.y, c.z});
    world.add(makeBilinearPatchMesh(2, false, 2, false, {floatsParam("P", ValueType::Point, Storage::Vertex, values)},
                                    problems));
  }
  world.build();
  return world;
}

struct Seen {
  vec3 P, N;
  float pdf = -1, meetPdf = -1;
  EmitterPoints out() { return {{&P.x, &P.y, &P.z}, {&N.x, &N.y, &N.z}, &pdf, &meetPdf}; }
};

TEST(Emitters, DirectionsMeetFlatMeshesWithTheDensityByWhichSamplesWeighThem) {
  World world;
  const Emitters& emitters = trapezia(world, 12).rays->emitters();
  const vec3 eye(0.1f, -0.05f, 0.3f);
  int same = 0, nearer = 0;
  for (uint32_t i = 0; i < 2000; ++i) {
    const vec2 xi = sobol2(i, 1);
    Seen sampled, met;
    ASSERT_TRUE(emitters.sampleFrom(0, 1, {&eye.x, &eye.y, &eye.z}, &xi.x, &xi.y, sampled.out()));
    if (!(sampled.pdf > 0)) continue;
    const vec3 d = glm::normalize(sampled.P - eye);
    emitters.meet(0, 1, {&eye.x, &eye.y, &eye.z}, {&d.x, &d.y, &d.z}, met.out());
    const bool isSame = glm::length(met.P - sampled.P) < 1e-4f;
    same += isSame;
    nearer += !isSame && glm::length(met.P - eye) < glm::length(sampled.P - eye);
    if (!isSame) continue;
    EXPECT_NEAR(met.pdf / sampled.meetPdf, 1, 1e-3f);
    EXPECT_GT(dot(met.N, sampled.N), 0.999f);
  }
  EXPECT_GT(same, 700);
  EXPECT_GT(nearer, 100) << "some of the band lies behind the rest";
  EXPECT_GT(same + nearer, 1500);
}

// The pdf of a direction that meets the light, integrated over all directions, is the share of samples that are
// seen.
TEST(Emitters, WhatDirectionsMeetAddsUpToTheWholeLight) {
  World world;
  world.attributes.areaLight = world.addAreaLight();
  world.add(parallelogram({-1, -1, 4}, {0.7f, 2, 0}, {2, 0, 0}));
  world.build();
  const vec3 eye(0.2f, 0.1f, 3);
  double sum = 0;
  constexpr uint32_t kDirections = 1 << 16;
  for (uint32_t i = 0; i < kDirections; ++i) {
    const vec2 xi = sobol2(i, 2);
    const float z = 1 - 2 * xi.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
    const vec3 d(r * std::cos(2 * kPi * xi.y), r * std::sin(2 * kPi * xi.y), z);
    Seen met;
    world.rays->emitters().meet(0, 1, {&eye.x, &eye.y, &eye.z}, {&d.x, &d.y, &d.z}, met.out());
    sum += 4 * double{kPi} * double{met.pdf} / kDirections;
  }
  EXPECT_NEAR(sum, 1, 0.01);
}

/// The density of all points in which a direction passes the light.
double densityAlong(const Emitters& emitters, const vec3& eye, const vec3& d) {
  double sum = 0;
  float before = 0;
  for (int layer = 0;; ++layer) {
    Seen met;
    emitters.meetWhole(0, layer, 1, {&eye.x, &eye.y, &eye.z}, {&d.x, &d.y, &d.z}, met.out());
    if (!(met.pdf > 0)) return sum;
    sum += double{met.pdf};
    EXPECT_GE(dot(met.P - eye, d), before) << "layers are in order";
    before = dot(met.P - eye, d);
  }
}

TEST(Emitters, WhatDirectionsMeetOfAllSidesAddsUpToTheWholeLight) {
  World band, square, round;
  trapezia(band, 12);
  square.attributes.areaLight = square.addAreaLight();
  square.add(parallelogram({-1, -1, 4}, {0.7f, 2, 0}, {2, 0, 0}));
  square.build();
  round.attributes.areaLight = round.addAreaLight();
  Problems problems;
  round.add(makeSphere(0.7f, -0.7f, 0.7f, 360, {}, problems));
  round.add(makeDisk(2, 0.6f, 360, {}, problems));
  round.build();
  for (World* world : {&band, &square, &round}) {
    const Emitters& emitters = world->rays->emitters();
    for (const vec3& eye : {vec3(0.1f, -0.05f, 0.3f), vec3(0.2f, 0.1f, 3), vec3(-1.5f, 1.2f, 1.5f)}) {
      double sum = 0;
      constexpr uint32_t kDirections = 1 << 16;
      for (uint32_t i = 0; i < kDirections; ++i) {
        const vec2 xi = sobol2(i, 2);
        const float z = 1 - 2 * xi.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
        sum += 4 * double{kPi} / kDirections *
               densityAlong(emitters, eye, {r * std::cos(2 * kPi * xi.y), r * std::sin(2 * kPi * xi.y), z});
      }
      EXPECT_NEAR(sum, 1, 0.03) << eye.z;
    }
  }
}

TEST(Emitters, PointsAllOverALightKnowTheDensityOfWhatDirectionsMeet) {
  World world;
  const Emitters& emitters = trapezia(world, 12).rays->emitters();
  const vec3 eye(0.1f, -0.05f, 1.3f);
  int found = 0;
  for (uint32_t i = 0; i < 500; ++i) {
    const vec2 xi = sobol2(i, 1);
    Seen sampled, met;
    ASSERT_TRUE(emitters.sampleWhole(0, 1, {&eye.x, &eye.y, &eye.z}, &xi.x, &xi.y, sampled.out()));
    const vec3 d = glm::normalize(sampled.P - eye);
    for (int layer = 0; layer < 3; ++layer) {
      emitters.meetWhole(0, layer, 1, {&eye.x, &eye.y, &eye.z}, {&d.x, &d.y, &d.z}, met.out());
      if (!(met.pdf > 0) || glm::length(met.P - sampled.P) > 1e-4f) continue;
      ++found;
      EXPECT_NEAR(met.pdf / sampled.meetPdf, 1, 1e-3f);
    }
  }
  EXPECT_GT(found, 490);
}

TEST(Emitters, OfMeshesOfThousandsOfPolygonsNoneAreMet) {
  World world;
  const Emitters& emitters = trapezia(world, 300).rays->emitters();
  const vec3 eye(0), d(1, 0, 0.1f);
  Seen met, sampled;
  const float xi = 0.5f;
  emitters.meet(0, 1, {&eye.x, &eye.y, &eye.z}, {&d.x, &d.y, &d.z}, met.out());
  emitters.sampleFrom(0, 1, {&eye.x, &eye.y, &eye.z}, &xi, &xi, sampled.out());
  EXPECT_EQ(met.pdf, 0);
  EXPECT_EQ(sampled.meetPdf, 0);
}

TEST(Emitters, NormalsFollowOrientation) {
  World world;
  world.attributes.areaLight = world.addAreaLight();
  world.attributes.insideOut = true;
  world.add(parallelogram({-1, 2, 4}, {2, 0, 0}, {0, 0, 3}));
  world.build();
  EXPECT_NEAR(sample(world, 0, 1).N[0].y, 1, 1e-5f);
}

TEST(Emitters, ALightWithoutGeometryHasNoSamples) {
  World world;
  const int none = world.addAreaLight();
  world.attributes.areaLight = world.addAreaLight();
  world.add(parallelogram({-1, 2, 4}, {0, 0, 0}, {0, 0, 3}));
  world.build();
  float x = 0.5f, out[7];
  for (const int light : {none, 1, -1, 2})
    EXPECT_FALSE(
        world.rays->emitters().sample(light, 1, &x, &x, {out, out + 1, out + 2}, {out + 3, out + 4, out + 5}, out + 6));
}

}  // namespace
}  // namespace tomales::test
