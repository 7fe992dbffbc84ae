#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "reyes/prim_factories.h"
#include "reyes/scene.h"

namespace tomales {
namespace {

mat4 rotation(float degrees, const vec3& axis = {0, 0, 1}) { return glm::rotate(mat4(1), glm::radians(degrees), axis); }
mat4 translation(const vec3& t) { return glm::translate(mat4(1), t); }

float difference(const mat4& a, const mat4& b) {
  float most = 0;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
  return most;
}

TEST(Motion, TurnsAlongTheArcBetweenKeys) {
  const Motion m{{0, 2}, {rotation(20, {1, 2, 3}), rotation(140, {1, 2, 3})}};
  for (const float t : {0.25f, 1.0f, 1.75f})
    EXPECT_LT(difference(m.at(t), rotation(20 + 60 * t, {1, 2, 3})), 1e-5f) << t;
}

TEST(Motion, MovesPlaceAndScaleLinearly) {
  const mat4 a = translation({1, 2, 3}) * glm::scale(mat4(1), vec3(1, 2, 4));
  const mat4 b = translation({3, 2, 1}) * glm::scale(mat4(1), vec3(3, 2, 2));
  EXPECT_LT(difference(Motion{{0, 1}, {a, b}}.at(0.25f), a * 0.75f + b * 0.25f), 1e-5f);
}

TEST(Motion, KeepsShapeWhileItTurnsAndStretches) {
  const mat4 a = rotation(10, {0, 1, 1}) * glm::scale(mat4(1), vec3(1, 2, -3));
  const mat4 b = rotation(100, {0, 1, 1}) * glm::scale(mat4(1), vec3(1, 2, -3));
  const mat4 expected = rotation(55, {0, 1, 1}) * glm::scale(mat4(1), vec3(1, 2, -3));
  EXPECT_LT(difference(Motion{{0, 1}, {a, b}}.at(0.5f), expected), 1e-5f);
}

TEST(Motion, ThroughAMirrorOrAFlatKeyIsLinear) {
  for (const vec3& s : {vec3(-1, 1, 1), vec3(0, 1, 1)}) {
    const mat4 a = rotation(30), b = glm::scale(mat4(1), s);
    EXPECT_EQ(difference(Motion{{0, 1}, {a, b}}.at(0.5f), a * 0.5f + b * 0.5f), 0);
  }
}

TEST(Motion, AtAKeyIsThatKey) {
  const Motion m{{0, 1, 3}, {rotation(0), rotation(40), rotation(170)}};
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(m.at(m.times[k]), m.keys[k]);
}

TEST(Motion, RefinedTurnsByTenDegreesAtMostAndPassesThroughItsKeys) {
  const Motion m{{0, 1, 2}, {rotation(0), rotation(175), rotation(178)}}, fine = m.refined();
  ASSERT_EQ(fine.keys.size(), 20u);  // 18 pieces and one.
  for (const float t : {0.0f, 1.0f, 2.0f}) EXPECT_EQ(fine.at(t), m.at(t));
  EXPECT_TRUE(std::is_sorted(fine.times.begin(), fine.times.end()));
  EXPECT_EQ((Motion{{0, 1}, {mat4(1), translation({9, 9, 9})}}.refined().keys.size()), 2u);
}

/// Distance from the axis of the centre of an object, vertex-wise linear between its key times.
float worstDistance(const Scene& scene, float radius) {
  const Object& o = scene.objects[0];
  float worst = 0;
  for (size_t k = 1; k < o.keyTimes.size(); ++k) {
    const vec3 a(o.cameraFromObject.at(o.keyTimes[k - 1])[3]), b(o.cameraFromObject.at(o.keyTimes[k])[3]);
    worst = std::max(worst, std::abs(glm::length(0.5f * (a + b)) / radius - 1));
  }
  return worst;
}

Scene arm(const Motion& worldFromArm, const Motion& cameraFromWorld = {}) {
  Scene scene;
  scene.options.shutterClose = 1;
  scene.cameraFromWorld = cameraFromWorld;
  Object o;
  Problems problems;
  o.shapes = {makeSphere(0.5f, -0.5f, 0.5f, 360, {}, problems)};
  o.attributes = std::make_shared<Attributes>();
  o.worldFromObject = worldFromArm * Motion::still(translation({2, 0, 0}));
  scene.objects.push_back(std::move(o));
  scene.freeze();
  return scene;
}

TEST(Motion, ASphereOnASpinningArmKeepsItsDistanceFromTheAxis) {
  const Motion quarter{{0, 1}, {rotation(0), rotation(90)}};
  EXPECT_EQ(arm(quarter).objects[0].keyTimes.size(), 10u);
  EXPECT_LT(worstDistance(arm(quarter), 2), 0.005f);
  EXPECT_LT(worstDistance(arm({{0, 1}, {rotation(0), rotation(170)}}), 2), 0.005f);
  // The camera may turn instead.
  EXPECT_LT(worstDistance(arm({}, quarter), 2), 0.005f);
}

TEST(Motion, KeyTimesOutsideTheShutterAreNotDiced) {
  Scene scene = arm({{-1, 3}, {rotation(0), rotation(160)}});
  EXPECT_LE(scene.objects[0].keyTimes.size(), 6u);  // 40 degrees inside.
  EXPECT_EQ(scene.objects[0].keyTimes.front(), 0);
  EXPECT_EQ(scene.objects[0].keyTimes.back(), 1);
}

TEST(Motion, WithoutSamplemotionTheCameraSeesTheOpeningOfTheShutter) {
  Scene scene;
  scene.options.shutterClose = 1;
  scene.options.sampleMotion = false;
  Problems problems;
  Object o;
  o.shapes = {makeSphere(1, -1, 1, 360, {}, problems)};
  o.worldFromObject = {{0, 1}, {mat4(1), glm::translate(mat4(1), vec3(1, 0, 0))}};
  o.attributes = std::make_shared<Attributes>();
  scene.objects.push_back(o);
  scene.freeze();
  EXPECT_EQ(scene.objects[0].keyTimes, std::vector<float>{0});
  EXPECT_TRUE(scene.objects[0].currentFromObject.moving()) << "rays may still see it move";
}

}  // namespace
}  // namespace tomales
