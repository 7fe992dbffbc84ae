// The box that stands for a Volume.
#include "reyes/density.h"
#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

TEST(Volume, IsTheClosedBoxOfItsDensityWithNormalsOutward) {
  const Bound3 box{{-1, 0, 2}, {1, 3, 7}};
  const auto density = std::make_shared<DensityGrid>(ivec3(0), ivec3(7), mat4(1.0f), box);
  Problems problems;
  const PrimPtr prim = makeVolume(density, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(prim->density(), density.get());
  EXPECT_GE(prim->bytes(), density->bytes());
  ASSERT_EQ(prim->patchCount(), 6u);
  EXPECT_FLOAT_EQ(static_cast<float>(dicedArea(*prim, 4)), 2 * (2 * 3 + 3 * 5 + 5 * 2));
  const vec3 center = 0.5f * (box.lo + box.hi), half = box.hi - center;
  for (uint32_t patch = 0; patch < 6; ++patch) {
    const Sample s = sampleAt(*prim, patch, 0.4f, 0.7f);
    const vec3 from = glm::abs(s.p - center) / half;
    EXPECT_FLOAT_EQ(maxComponent(from), 1) << "it lies on the box";
    EXPECT_GT(dot(s.n, s.p - center), 0);
    EXPECT_EQ(prim->info(patch).openEdges, 0) << patch;
    for (const PatchEdge edge : {kEdgeU0, kEdgeU1, kEdgeV0, kEdgeV1}) {
      const auto ends = prim->straightEdge(patch, edge);
      ASSERT_TRUE(ends);
      for (const vec3& end : *ends) EXPECT_EQ(glm::abs(end - center), half);
    }
  }
  expectBoundsContainTheSurface(*prim, 500);
}

}  // namespace
}  // namespace tomales
