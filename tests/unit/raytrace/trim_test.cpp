// Rays and light samples pass through what trim curves cut away.
#include <gtest/gtest.h>

#include "raytrace/emitters.h"
#include "reyes/base/rng.h"
#include "world.h"

namespace tomales::test {
namespace {

/// The square -1..1 at z = 0 with a square hole -0.5..0.5 around (0.1, 0), or only the square that the hole would be.
PrimPtr sheet(bool keepsInside) {
  TrimCurve hole{{5, 2, {0, 0, 1, 2, 3, 4, 4}, 0, 4}, {}};
  for (const vec2& p : {vec2(-0.5f, -0.5f), vec2(0.5f, -0.5f), vec2(0.5f, 0.5f), vec2(-0.5f, 0.5f), vec2(-0.5f, -0.5f)})
    hole.controls.emplace_back(p + vec2(0.1f, 0), 1);
  const NurbsDirection line{2, 2, {-1, -1, 1, 1}, -1, 1};
  Problems problems;
  return makeNuPatch(line, line, {{{hole}}, keepsInside},
                     {floatsParam("P", ValueType::Point, Storage::Vertex, {-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0})},
                     problems);
}
bool inHole(const vec2& p) { return std::abs(p.x - 0.1f) < 0.5f && std::abs(p.y) < 0.5f; }
bool nearEdge(const vec2& p) {
  return std::abs(std::abs(p.x - 0.1f) - 0.5f) < 1e-4f || std::abs(std::abs(p.y) - 0.5f) < 1e-4f;
}

TEST(TrimmedForRays, RaysPassThroughTheHoleAndMeetTheRest) {
  for (const bool keepsInside : {false, true})
    for (const float tessellation : {0.01f, 1.0f}) {
      World world;
      world.attributes.trace.tessellation = tessellation;
      const int self = world.add(sheet(keepsInside), translation({0, 0, 4}));
      world.build();
      for (uint32_t i = 0; i < 2000; ++i) {
        const vec2 at = 1.98f * sobol2(i, 5) - 0.99f;
        if (nearEdge(at)) continue;
        const bool there = inHole(at) == keepsInside;
        const Ray ray{vec3(at, 2), {0, 0, 1}, 5};
        EXPECT_EQ(world.rays->closest(ray, kMaskDiffuse).object >= 0, there) << at.x << ' ' << at.y;
        EXPECT_EQ(world.transmission(ray), vec3(there ? 0.0f : 1.0f));
        // With a hit list, from the surface itself.
        const Ray own = world.rayFrom(self, vec3(at, 4), {0, 0, -1}, 3);
        EXPECT_EQ(world.transmission(own), vec3(1));
      }
    }
}

TEST(TrimmedForRays, ALampShinesWithItsTrimmedArea) {
  World world;
  world.attributes.areaLight = world.addAreaLight();
  world.add(sheet(false), translation({0, 0, 4}));
  world.build();
  constexpr int kCount = 8192;
  std::vector<float> xi0, xi1, data[6], area(kCount);
  for (auto& d : data) d.resize(kCount);
  for (uint32_t i = 0; i < kCount; ++i) {
    xi0.push_back(sobol2(i, 11).x);
    xi1.push_back(sobol2(i, 11).y);
  }
  ASSERT_TRUE(world.rays->emitters().sample(0, kCount, xi0.data(), xi1.data(),
                                            {data[0].data(), data[1].data(), data[2].data()},
                                            {data[3].data(), data[4].data(), data[5].data()}, area.data()));
  double mean = 0;
  for (size_t i = 0; i < kCount; ++i) {
    mean += double{area[i]} / kCount;
    const vec2 at(data[0][i], data[1][i]);
    EXPECT_TRUE(area[i] == 0 || nearEdge(at) || !inHole(at));
  }
  EXPECT_NEAR(mean, 3, 0.03);
}

}  // namespace
}  // namespace tomales::test
