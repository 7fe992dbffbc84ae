#include "raytrace/surroundings.h"

#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "tests/unit/directions.h"
#include "world.h"

namespace tomales::test {
namespace {

struct Differences {
  int rays = 0, adjusted = 0, wrong = 0;
  float farthest = 0;  ///< Between the places of hits that agree.
};

/// Rays from P with and without what is known to lie around it, in all directions that go along each axis by more than
/// `least`.
void compare(const World& world, int object, const vec3& P, Differences& out, const vec3& least = vec3(-1)) {
  Ray ray = world.rayFrom(object, P, {0, 0, 1});
  const float offset = ray.offset;
  Surroundings around;
  world.rays->lookAround(ray, 2 * offset, kMaskDiffuse, around);
  for (uint32_t i = 0; i < 100; ++i) {
    ray.direction = anyDirection(i);
    if (!glm::all(glm::greaterThanEqual(ray.direction, least))) continue;
    ray.offset = offset * (1 + unitFloat(hash32(i)));
    ray.surroundings = nullptr;
    const Hit without = world.rays->closest(ray, kMaskDiffuse);
    ray.surroundings = &around;
    const Hit with = world.rays->closest(ray, kMaskDiffuse);
    const bool same = with.object == without.object && with.adjusted == without.adjusted;
    ++out.rays;
    out.adjusted += with.adjusted;
    out.wrong += !same;
    if (same && with.object >= 0) out.farthest = std::max(out.farthest, std::abs(with.t - without.t));
  }
}

TEST(Surroundings, RaysMeetWhatTheyMeetWithoutThem) {
  World world;
  world.addRoom({-1, -1, 2}, {1, 1, 4});
  const int ball = world.add(sphere(0.5f), translation({0.2f, -0.1f, 3.2f}));
  world.add(parallelogram({-0.9f, -0.9f, 3}, {1.8f, 0.1f, 0.3f}, {0.1f, 1.8f, 0.4f}));
  world.build();
  Differences d;
  for (uint32_t i = 0; i < 300; ++i) {
    const vec2 off = sobol2(i, 3);
    compare(world, ball, vec3(0.2f, -0.1f, 3.2f) + (0.495f + 0.01f * off.x) * anyDirection(i), d);
    compare(world, 0, {2 * off.x - 1, 2 * off.y - 1, 2}, d, {-1, -1, 0.02f});                      // on a wall,
    compare(world, 0, {-1, 2 * off.y - 1, 2 + 1e-5f * off.x}, d, {0.02f, -1, 0.02f});              // where two meet,
    compare(world, 0, vec3(-1, -1, 2) + 1e-5f * vec3(off.x, off.y, 1), d, {0.02f, 0.02f, 0.02f});  // and where three do
  }
  EXPECT_GT(d.rays, 40000);
  EXPECT_GT(d.adjusted, d.rays / 2);
  EXPECT_EQ(d.wrong, 0);
  EXPECT_LT(d.farthest, 1e-4f);
}

TEST(Surroundings, NoRaySlipsBetweenPolygons) {
  // A hilly fan around the z axis, seen from a point close to it.
  constexpr int kSpokes = 8;
  const auto rim = [](int k, float r) {
    const float a = 2 * kPi * static_cast<float>(k % kSpokes) / kSpokes;
    return vec3(r * std::cos(a), r * std::sin(a), (k % 2 ? 0.11f : -0.07f) * r);
  };
  Surroundings around;
  for (uint32_t i = 0; i < 50; ++i) {
    const vec3 eye(0.1f * sobol2(i, 1), 0.13f);
    around.reset(eye, 10);
    for (int k = 0; k < kSpokes; ++k)
      around.add(0, static_cast<uint32_t>(k), false,
                 {vec3(0), rim(k, 1), 0.5f * (rim(k, 1.5f) + rim(k + 1, 1.5f)), rim(k + 1, 1)});
    for (int k = 0; k < 1000; ++k) {
      // At spokes, the center among them, where rounding puts rays on either side.
      const vec3 at = rim(k, static_cast<float>(k / kSpokes) / 126);
      HitList list;
      around.meet(glm::normalize(at - eye), 10, list);
      EXPECT_FALSE(list.empty()) << at.x << " " << at.y;
      for (const PolygonHit& hit : list) EXPECT_NEAR(hit.t, glm::length(at - eye), 1e-5f);
    }
  }
}

TEST(Surroundings, PlaceAndSenseOfAHitAreThoseOfAnyOther) {
  World world;
  world.add(parallelogram({-1, -1, 3}, {2, 0, 0.5f}, {0, 2, 0.25f}));
  world.build();
  int met = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    const vec3 P(1.8f * sobol2(i, 1) - 0.9f, 3.1f), d = anyDirection(i);
    Ray ray{P, d};
    ray.offset = 1e-3f;  // what is met lies behind it
    const Hit far = world.rays->closest(ray, kMaskDiffuse);
    ray.offset = 1;
    ray.origin += 1.5f * d;
    Surroundings around;
    world.rays->lookAround(ray, 1, kMaskDiffuse, around);
    HitList list;
    around.meet(d, 4, list);
    if (far.object < 0 || far.t > 2 || far.t < 1) continue;
    ASSERT_EQ(list.size(), 1u);
    EXPECT_NEAR(list[0].t, far.t - 1.5f, 1e-5f);
    EXPECT_NEAR(list[0].u, far.u, 1e-5f);
    EXPECT_NEAR(list[0].v, far.v, 1e-5f);
    EXPECT_EQ(list[0].leaving, dot(far.geometricNormal, d) > 0);
    ++met;
  }
  EXPECT_GT(met, 40);
}

TEST(Surroundings, GiveUpWhereTheyWouldCostMore) {
  Surroundings around;
  EXPECT_FALSE(around.know({}, 0)) << "nobody has looked";
  around.reset({}, 1);
  EXPECT_TRUE(around.know({}, 1));
  EXPECT_FALSE(around.know({}, 1.1f));
  EXPECT_FALSE(around.know({0.1f, 0, 0}, 1));
  for (uint32_t i = 0; i <= Surroundings::kMost; ++i)
    around.add(0, i, false, {vec3(-1, -1, 0), vec3(1, -1, 0), vec3(1, 1, 0), vec3(-1, 1, 0)});
  EXPECT_TRUE(around.gaveUp());
}

TEST(Surroundings, HoldPolygonsOfInstances) {
  const mat4 places[] = {translation({0, 0, 5}),
                         mat4(vec4(0.8f, 0.3f, 0, 0), vec4(-0.2f, 0.7f, 0.1f, 0), vec4(0, 0.2f, 1.1f, 0),
                              vec4(0.1f, 0, 5.02f, 1)),  // skewed,
                         mat4(vec4(-1.2f, 0, 0, 0), vec4(0, 0.9f, 0.2f, 0), vec4(0, 0, 1.3f, 0),
                              vec4(-0.1f, 0.1f, 4.97f, 1))};  // mirrored
  World world;
  const PrimPtr shared = waves();
  for (const mat4& place : places) world.add(shared, place);
  world.attributes.visibility.diffuse = false;
  world.add(shared, translation({0, 0, 4.99f}));
  world.build();
  Surroundings around;
  Differences d;
  HitList list;
  for (uint32_t i = 0; i < 200; ++i) {
    const vec3 P(1.6f * sobol2(i, 1) - 0.8f, 5 + 0.1f * sobol1(i, 2));
    compare(world, static_cast<int>(i % 3), P, d);
    // Each hit with its place on its instance and its sense.
    world.rays->lookAround(Ray{P, {0, 0, 1}}, 0.05f, kMaskDiffuse, around);
    ASSERT_TRUE(around.know(P, 0.05f));
    list.clear();
    around.meet({0, 0, 1}, 0.05f, list);
    for (const PolygonHit& hit : list) {
      ASSERT_GE(hit.instance, 0);
      Ray ray{P + vec3(0, 0, hit.t - 1e-3f), {0, 0, 1}};
      const Hit met = world.rays->closest(ray, kMaskDiffuse);
      if (met.t > 2e-3f) continue;  // two of them closer than that
      EXPECT_EQ(hit.leaving, met.geometricNormal.z > 0);
    }
  }
  EXPECT_GT(d.rays, 15000);
  EXPECT_GT(d.adjusted, d.rays / 4);
  EXPECT_EQ(d.wrong, 0);
  EXPECT_LT(d.farthest, 1e-4f);
}

TEST(Surroundings, LeaveOutWhatTheRayDoesNotSee) {
  World world;
  world.attributes.trace.offset = 0.1f;
  const int floor = world.add(parallelogram({-1, -1, 3}, {0, 2, 0}, {2, 0, 0}));
  world.attributes.visibility.diffuse = false;
  world.add(parallelogram({-1, -1, 2.95f}, {0, 2, 0}, {2, 0, 0}));
  world.build();
  Ray ray = world.rayFrom(floor, {0.1f, 0.2f, 3}, {0, 0, -1});
  Surroundings around;
  world.rays->lookAround(ray, ray.offset, kMaskDiffuse, around);
  ray.surroundings = &around;
  EXPECT_TRUE(around.know(ray.origin, ray.offset));
  EXPECT_EQ(world.rays->closest(ray, kMaskDiffuse).object, -1);
  world.rays->lookAround(ray, ray.offset, kMaskSpecular, around);
  EXPECT_EQ(world.rays->closest(ray, kMaskSpecular).object, 1);
  const std::vector<uint8_t> none(world.scene.groups.size(), 0);
  const RayFilter filter{&none};
  ray.filter = &filter;
  EXPECT_EQ(world.rays->closest(ray, kMaskSpecular).object, -1);
}

}  // namespace
}  // namespace tomales::test
