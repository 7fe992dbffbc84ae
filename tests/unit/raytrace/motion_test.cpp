// Rays in a world that moves, against closed forms.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "raytrace/motion_keys.h"
#include "world.h"

namespace tomales::test {
namespace {

/// Rays of the objects see motion over a shutter from 0 to 1.
struct MovingWorld : World {
  MovingWorld() {
    scene.options.shutterClose = 1;
    attributes.trace.sampleMotion = true;
  }
};

PrimPtr unitSquare() { return parallelogram({0, -1, 0}, {1, 0, 0}, {0, 2, 0}); }

/// Where the left edge of what stands at z = 4 is at a time, by bisection along a row of rays.
float leftEdge(const World& world, float time) {
  float left = -3, right = -3;
  const auto meets = [&](float x) {
    Ray ray{{x, 0, 0}, {0, 0, 1}};
    ray.time = time;
    return world.rays->closest(ray, kMaskDiffuse).object >= 0;
  };
  while (!meets(right) && right < 6) right += 0.25f;
  for (int step = 0; step < 24; ++step) {
    const float middle = 0.5f * (left + right);
    (meets(middle) ? right : left) = middle;
  }
  return right;
}

TEST(RayMotion, ASquareIsMetWhereItIsAtTheTimeOfTheRay) {
  MovingWorld world;
  world.add(unitSquare());
  // Keys before, inside and after the shutter, not equally spaced; constant after the last.
  world.scene.objects[0].worldFromObject = {{-1, 0.25f, 0.75f},
                                            {translation({-2, 0, 4}), translation({0, 0, 4}), translation({2, 0, 4})}};
  world.build();
  for (const float time : {0.0f, 0.1f, 0.25f, 0.3f, 0.5f, 0.75f, 0.9f}) {
    const float x = time < 0.25f ? -2 + (time + 1) * 1.6f : time < 0.75f ? (time - 0.25f) * 4 : 2;
    EXPECT_NEAR(leftEdge(world, time), x, 1e-4f) << time;
  }
}

TEST(RayMotion, KeysOutsideTheShutterMoveNothing) {
  for (const auto& times : {std::vector<float>{-3, -1}, std::vector<float>{2, 5}}) {
    MovingWorld world;
    world.add(unitSquare());
    world.scene.objects[0].worldFromObject = {times, {translation({-2, 0, 4}), translation({1, 0, 4})}};
    world.build();
    const float x = times[0] < 0 ? 1 : -2;
    EXPECT_EQ(motionKeyTimes(world.scene)[0].size(), 1u);
    for (const float time : {0.0f, 0.6f}) EXPECT_NEAR(leftEdge(world, time), x, 1e-5f);
  }
}

TEST(RayMotion, TurnsAlongTheArc) {
  MovingWorld world;
  // A small plate on an arm of length 2 sweeps a quarter circle.
  world.add(parallelogram({1.9f, -0.1f, 0}, {0.2f, 0, 0}, {0, 0.2f, 0}));
  const mat4 place = translation({0, 0, 5});
  world.scene.objects[0].worldFromObject = Motion{{0, 1}, {place, glm::rotate(place, kPi / 2, vec3(0, 0, 1))}};
  world.build();
  for (int k = 0; k <= 18; ++k) {
    const float time = static_cast<float>(k) / 18, angle = time * kPi / 2;
    Ray ray{{2 * std::cos(angle), 2 * std::sin(angle), 0}, {0, 0, 1}};
    ray.time = std::min(time, 0.99999f);
    const Hit hit = world.rays->closest(ray, kMaskDiffuse);
    ASSERT_EQ(hit.object, 0) << k;
    EXPECT_LT(glm::length(hit.atOpen - vec3(2, 0, 5)), 0.02f) << "the arm's end, where it was at shutter open";
  }
}

TEST(RayMotion, DeformationIsLinearBetweenShapes) {
  MovingWorld world;
  world.add(unitSquare(), translation({0, 0, 4}));
  Object& o = world.scene.objects[0];
  o.shapes.push_back(parallelogram({2, -1, 0}, {1, 0, 0}, {0, 2, 0}));
  o.shapeTimes = {0, 1};
  world.build();
  for (const float time : {0.0f, 0.25f, 0.7f}) EXPECT_NEAR(leftEdge(world, time), 2 * time, 1e-4f);
  EXPECT_NEAR(world.rays->placeAt(0, {0, 0, 4}, {2, 0, 0}, 0.5f).x, 1, 1e-6f);
}

TEST(RayMotion, TheCamerasOwnMotionMovesNothing) {
  MovingWorld world;
  world.add(unitSquare(), translation({0, 0, 4}));
  world.add(sphere(0.1f), translation({0, 0, 40}));
  world.scene.cameraFromWorld = {{0, 1}, {mat4(1), translation({5, 0, 0})}};
  world.scene.objects[1].worldFromObject = {{0, 1}, {translation({0, 9, 4}), translation({1, 9, 4})}};
  world.build();
  EXPECT_GT(world.scene.objects[0].keyTimes.size(), 1u) << "the camera sees it blurred";
  for (const float time : {0.0f, 0.5f}) EXPECT_NEAR(leftEdge(world, time), 0, 1e-5f);
}

TEST(RayMotion, IsForObjectsThatSampleItAlone) {
  MovingWorld world;
  world.attributes.trace.sampleMotion = false;
  world.add(unitSquare());
  world.scene.objects[0].worldFromObject = {{0, 1}, {translation({0, 0, 4}), translation({2, 0, 4})}};
  world.build();
  EXPECT_FALSE(world.rays->samplesTime(0));
  EXPECT_NEAR(leftEdge(world, 0.9f), 0, 1e-5f);
  EXPECT_EQ(motionKeyTimes(world.scene)[0].size(), 1u) << "no memory for motion that no ray sees";
}

TEST(RayMotion, AreaLightsStandWhereTheyAreAtShutterOpen) {
  MovingWorld world;
  world.attributes.areaLight = world.addAreaLight();
  world.add(unitSquare());
  world.scene.objects[0].worldFromObject = {{0, 1}, {translation({0, 0, 4}), translation({2, 0, 4})}};
  world.build();
  EXPECT_NEAR(leftEdge(world, 0.9f), 0, 1e-5f);
}

TEST(RayMotion, KeysDivideTheShutterAsFinelyAsTheObjectsNeed) {
  MovingWorld world;
  world.add(unitSquare());
  world.scene.objects[0].worldFromObject = {
      {0, 0.25f, 0.5f, 1}, {mat4(1), translation({1, 0, 0}), translation({2, 0, 0}), translation({9, 0, 0})}};
  world.build();
  EXPECT_EQ(motionKeyTimes(world.scene)[0], (std::vector<float>{0, 0.25f, 0.5f, 0.75f, 1}));
}

}  // namespace
}  // namespace tomales::test
