#include "raytrace/tessellate.h"

#include <gtest/gtest.h>

#include "reyes/dice.h"
#include "world.h"

namespace tomales::test {
namespace {

std::vector<CoarseGroup> coarse(World& world) {
  world.build();
  return tessellate(world.scene, *world.camera, *world.shading, world.log);
}

float longestEdge(const CoarseGroup& g) {
  float longest = 0;
  for (uint32_t q = 0; q < g.quads.size(); ++q)
    for (int k = 0; k < 4; ++k) longest = std::max(longest, glm::length(g.corner(q, k) - g.corner(q, (k + 1) % 4)));
  return longest;
}

TEST(Tessellate, AFlatPatchIsOneExactQuad) {
  World world;
  world.add(parallelogram({-1, -1, 2}, {2, 0, 0}, {0.5f, 2, 1}));
  const auto groups = coarse(world);
  ASSERT_EQ(groups.size(), 1u);
  ASSERT_EQ(groups[0].quads.size(), 1u);
  EXPECT_EQ(groups[0].corner(0, 2), vec3(1.5f, 1, 3));
  EXPECT_LT(groups[0].deviation, 1e-6f);
}

TEST(Tessellate, PolygonsInViewAreAboutSixteenPixelsLong) {
  for (const float tessellation : {1.0f, 4.0f})
    for (const float shadingRate : {1.0f, 4.0f}) {
      World world;
      world.attributes.shadingRate = shadingRate;
      world.attributes.trace.tessellation = tessellation;
      world.add(sphere(), translation({0, 0, 3}));
      const auto groups = coarse(world);
      const float pixel = world.camera->pixelSize({0, 0, 2}), expected = 16 * std::sqrt(shadingRate) / tessellation;
      EXPECT_LT(longestEdge(groups[0]),
                expected * pixel * 1.8f);  // the rate is that of the average distance along a line
      EXPECT_GT(longestEdge(groups[0]), expected * pixel * 0.6f);
    }
}

TEST(Tessellate, OutOfViewTheTurnOfTheNormalDecides) {
  World world;
  world.add(sphere(), translation({0, 0, -2}));
  const CoarseGroup group = coarse(world)[0];
  EXPECT_NEAR(static_cast<double>(group.quads.size()), 24 * 12, 15);
  for (const Quad& q : group.quads)
    for (size_t k = 0; k < 4; ++k) EXPECT_GT(dot(group.N[q[k]], group.N[q[(k + 1) % 4]]), std::cos(16 * kPi / 180));
}

TEST(Tessellate, TheDeviationIsTheSagittaOfTheChords) {
  World world;
  world.add(sphere(), translation({0, 0, -2}));
  // A quad of 15 x 15 degrees: its centre lies deeper than one chord and no deeper than two.
  const float sagitta = 1 - std::cos(7.5f * kPi / 180);
  const float deviation = coarse(world)[0].deviation;
  EXPECT_GT(deviation, sagitta);
  EXPECT_LT(deviation, 2.1f * sagitta);
}

TEST(Tessellate, ObjectsOfAGroupAreMergedAndFoundAgain) {
  World world;
  const auto shared = std::make_shared<Attributes>(world.attributes);
  for (int i = 0; i < 3; ++i) {
    world.add(parallelogram({2.0f * static_cast<float>(i), -1, 2}, {1, 0, 0}, {0, 1, 0}));
    world.scene.objects.back().attributes = shared;
  }
  const auto groups = coarse(world);
  ASSERT_EQ(groups.size(), 1u);
  ASSERT_EQ(groups[0].quads.size(), 3u);
  for (uint32_t q = 0; q < 3; ++q) {
    EXPECT_EQ(groups[0].latticeOf(q).object, static_cast<int>(q));
    EXPECT_EQ(groups[0].corner(q, 0).x, 2.0f * static_cast<float>(q));
  }
}

TEST(Tessellate, TilesOfALargePatchShareTheirVertices) {
  World world;
  world.attributes.trace.tessellation = 8;
  world.add(sphere(), translation({0, 0, 3}));
  const auto groups = coarse(world);
  ASSERT_GT(groups[0].lattices.size(), 4u);
  for (uint32_t q = 0; q < groups[0].quads.size(); q += 37) {
    const Lattice& l = groups[0].latticeOf(q);
    const vec2 uv = groups[0].patchParameters(q, 0, 0), opposite = groups[0].patchParameters(q, 1, 1);
    const Grid exact = diceAtOpen(world.scene, 0, l.patch, {uv.x, opposite.x, uv.y, opposite.y}, 1, 1);
    EXPECT_LT(glm::length(exact.position(0, 0) - groups[0].corner(q, 0)), 1e-5f);
    EXPECT_LT(glm::length(exact.position(0, 3) - groups[0].corner(q, 2)), 1e-5f);
  }
}

TEST(Tessellate, DisplacedPolygonsReachTheRateOfMicropolygons) {
  World world;
  world.attributes.trace.displacements = true;
  world.attributes.trace.tessellation = 16;
  world.attributes.displacement = shader("noisybump", {floatsParam("Km", ValueType::Float, Storage::Uniform, {0.1f})});
  world.attributes.displacementBound = 0.1f;
  world.add(parallelogram({-1, -1, 3}, {0, 2, 0}, {2, 0, 0}));
  const auto groups = coarse(world);
  const float side_px = 2 / world.camera->pixelSize({0, 0, 3});
  EXPECT_GT(static_cast<float>(groups[0].quads.size()), 0.9f * side_px * side_px);
  float lowest = 3, highest = 3;
  for (const vec3& p : groups[0].P) {
    lowest = std::min(lowest, p.z);
    highest = std::max(highest, p.z);
  }
  EXPECT_GT(highest - lowest, 0.05f);
  EXPECT_LT(groups[0].deviation, 0.01f);
}

TEST(Tessellate, ASphereSmallerThanAPixelKeepsItsShape) {
  for (const float radius : {0.01f, 1e-4f}) {
    World world;
    world.add(sphere(radius), translation({0, 0, 5}));
    const CoarseGroup g = coarse(world)[0];
    EXPECT_LE(g.quads.size(), 16u);
    float area = 0;
    for (const Quad& q : g.quads) area += 0.5f * glm::length(cross(g.P[q[2]] - g.P[q[0]], g.P[q[3]] - g.P[q[1]]));
    EXPECT_GT(area, 2 * kPi * radius * radius) << "half the sphere's";
  }
}

TEST(Tessellate, AnAbsurdRateIsLimitedAndReported) {
  World world;
  world.attributes.trace.tessellation = 1e4f;
  world.attributes.visibility.camera = false;
  world.add(sphere(), translation({0, 0, -2}));
  world.scene.freeze();
  world.camera = std::make_unique<Camera>(world.scene.options);
  world.shading = std::make_unique<ShadingSystem>(world.scene, world.registry, nullptr, world.log, world.stats);
  const auto groups = tessellate(world.scene, *world.camera, *world.shading, world.log);
  EXPECT_LE(groups[0].quads.size(), size_t{1} << 22);
  EXPECT_EQ(world.log.count("trace-tessellation"), 1);
}

TEST(Tessellate, ASmallPictureAsksForFewPolygonsOfAnEnormousPatch) {
  World world;
  world.scene.options.xResolution = world.scene.options.yResolution = 16;
  world.scene.options.projection = ProjectionKind::Orthographic;
  world.add(sphere(), mat4(mat3(1e6f)));
  const auto groups = coarse(world);
  EXPECT_GT(groups[0].quads.size(), size_t{1} << 14);
  EXPECT_LE(groups[0].quads.size(), size_t{1} << 16);
  EXPECT_GT(world.log.count("trace-tessellation"), 0);
}

TEST(Tessellate, EdgesGrowUntilPolygonsFitTheMemory) {
  World world;
  for (int i = 0; i < 20; ++i) world.add(sphere(), translation({0, 0, 3}));
  size_t quads[2] = {};
  for (const size_t bytes : {size_t{1} << 30, size_t{1} << 16}) {
    const bool isFew = bytes < (size_t{1} << 20);
    if (!isFew) coarse(world);
    const float longer = edgesThatFit(world.scene, *world.camera, {}, bytes, world.log);
    EXPECT_EQ(longer > 1, isFew);
    EXPECT_EQ(world.log.count("trace-memory"), isFew ? 1 : 0);
    for (const CoarseGroup& g : tessellate(world.scene, *world.camera, *world.shading, world.log, {}, longer))
      quads[isFew] += g.quads.size();
  }
  EXPECT_LE(125 * quads[1], size_t{1} << 16);
  EXPECT_GE(125 * quads[1], size_t{1} << 14);
  EXPECT_GT(quads[0], 3 * quads[1]);
}

TEST(Tessellate, TheEnormousPatchesOfOneObjectShareWhatASmallPictureAsksFor) {
  World world;
  world.scene.options.xResolution = world.scene.options.yResolution = 16;
  world.scene.options.projection = ProjectionKind::Orthographic;
  world.add(waves(), mat4(mat3(1e6f)));  // 64 patches
  const auto groups = coarse(world);
  EXPECT_GT(groups[0].quads.size(), size_t{1} << 12);
  EXPECT_LE(groups[0].quads.size(), size_t{1} << 16);
}

}  // namespace
}  // namespace tomales::test
