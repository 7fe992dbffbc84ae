#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "raytrace/emitters.h"
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
    xi0[i] = xi.x, xi1[i] = xi.y;
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
  EXPECT_NEAR(
      static_cast<double>(std::count_if(s.P.begin(), s.P.end(), [](const vec3& p) { return p.x < 1; })), 1000,
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
    EXPECT_FALSE(world.rays->emitters().sample(light, 1, &x, &x, {out, out + 1, out + 2},
                                           {out + 3, out + 4, out + 5}, out + 6));
}

}  // namespace
}  // namespace tomales::test
