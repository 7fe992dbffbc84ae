#include "raytrace/visible_displacement.h"

#include <gtest/gtest.h>

#include "reyes/world_sum.h"
#include "tests/unit/raytrace/world.h"

namespace tomales::test {
namespace {

void displaceBy(World& world, float height) {
  world.attributes.displacement =
      shader("noisybump", {floatsParam("Km", ValueType::Float, Storage::Uniform, {height})});
  world.attributes.displacementBound = height;
}

void choose(World& world) {
  world.scene.freeze();
  world.camera = std::make_unique<Camera>(world.scene.options);
  world.shading = std::make_unique<ShadingSystem>(world.scene, world.registry, nullptr, world.log, world.stats);
  const uint64_t name = worldSum(world.scene);
  chooseDisplacements(world.scene, *world.camera, *world.shading, world.log);
  EXPECT_EQ(worldSum(world.scene), name) << "maps of the world are those of every camera";
}

const Attributes::Trace& traceOf(const World& world, size_t object) {
  return world.scene.objects[object].attributes->trace;
}

TEST(VisibleDisplacement, RaysSeeWhatMovesPointsByMoreThanAPixel) {
  World world;
  const float pixel = 2 * std::tan(kPi / 6) / 256 * 2;  // where the sphere is nearest
  for (const float height_px : {0.5f, 8.0f}) {
    displaceBy(world, height_px * pixel);
    world.add(sphere(), translation({0, 0, 3}));
  }
  choose(world);
  EXPECT_FALSE(traceOf(world, 0).displacements);
  EXPECT_EQ(traceOf(world, 0).tessellation, 1);
  EXPECT_TRUE(traceOf(world, 1).displacements);
  EXPECT_EQ(traceOf(world, 1).tessellation, 4);
  const int group = world.scene.objects[1].group;
  EXPECT_EQ(world.scene.groups[static_cast<size_t>(group)].attributes, world.scene.objects[1].attributes);
}

TEST(VisibleDisplacement, WhatTheSceneSaysStays) {
  World world;
  displaceBy(world, 0.2f);
  world.attributes.trace.displacementsGiven = true;
  world.add(sphere(), translation({0, 0, 3}));
  choose(world);
  EXPECT_FALSE(traceOf(world, 0).displacements);
}

TEST(VisibleDisplacement, WhatIsOutOfViewKeepsItsSmoothSurface) {
  World world;
  displaceBy(world, 0.2f);
  world.add(sphere(), translation({0, 0, -3}));
  world.add(sphere(), translation({9, 0, 3}));
  choose(world);
  for (size_t i = 0; i < 2; ++i) EXPECT_FALSE(traceOf(world, i).displacements) << i;
}

TEST(VisibleDisplacement, WhatRaysAloneSeeIsAsWhatTheCameraSees) {
  World world;
  displaceBy(world, 0.2f);
  world.attributes.visibility.camera = false;
  world.add(sphere(), translation({0, 0, 3}));
  choose(world);
  EXPECT_TRUE(traceOf(world, 0).displacements) << "it stands in for something in shadows and mirrors";
}

TEST(VisibleDisplacement, MorePolygonsThanThePictureHasPixelsAreNotMadeAndThatIsSaid) {
  World world;
  for (int i = 0; i < 40; ++i) {
    displaceBy(world, i == 20 ? 0.2f : 0.1f);
    world.attributes.name = std::to_string(i);  // a group each
    world.add(sphere(), translation({0, 0, 3}));
  }
  choose(world);
  EXPECT_TRUE(traceOf(world, 20).displacements) << "the greatest comes first";
  EXPECT_EQ(traceOf(world, 20).tessellation, 4);
  EXPECT_TRUE(traceOf(world, 0).displacements);
  EXPECT_FALSE(traceOf(world, 39).displacements);
  EXPECT_EQ(world.log.count("trace-displacement"), 1) << "for all of them";
}

TEST(VisibleDisplacement, GroundToTheHorizonIsNotCutIntoPolygonsThatBumpsWouldFallBetween) {
  World world;
  displaceBy(world, 0.2f);
  world.add(parallelogram({-1e4f, -1, -1e4f}, {0, 0, 2e4f}, {2e4f, 0, 0}));
  choose(world);
  EXPECT_FALSE(traceOf(world, 0).displacements);
  EXPECT_EQ(world.log.count("trace-displacement"), 1);
}

}  // namespace
}  // namespace tomales::test
