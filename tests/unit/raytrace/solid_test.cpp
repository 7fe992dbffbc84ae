// Solids and levels of detail as rays see them.
#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "tests/unit/raytrace/world.h"

namespace tomales::test {
namespace {

/// A solid of two balls: radius 1 at the origin, and `radius` at `center`.
struct Balls : World {
  Balls(SolidOperation operation, const vec3& center, float radius) {
    Solid solid;
    solid.add(operation, -1);
    for (int k = 0; k < 2; ++k) {
      const int object = add(sphere(k == 0 ? 1 : radius), translation(k == 0 ? vec3(0) : center));
      scene.objects[static_cast<size_t>(object)].solid = 0;
      scene.objects[static_cast<size_t>(object)].solidBlock = solid.add(SolidOperation::Primitive, 0);
    }
    scene.solids.push_back(solid);
  }
};

TEST(SolidsForRays, MatchMembershipOfPointsAlongRandomRays) {
  for (const SolidOperation operation :
       {SolidOperation::Union, SolidOperation::Intersection, SolidOperation::Difference}) {
    const vec3 center(0.6f, 0.2f, -0.3f);
    Balls w(operation, center, 0.8f);
    w.attributes.trace.tessellation = 4;
    w.build();
    int compared = 0;
    for (uint32_t k = 0; k < 400; ++k) {
      const auto random = [&](uint32_t d) { return 2 * unitFloat(hashCombine(k, d)) - 1; };
      Ray ray{vec3(random(0), random(1), random(2)) * 3.0f,
              normalizeOr({random(3), random(4), random(5)}, vec3(1, 0, 0))};
      const auto inside = [&](float t) {
        const vec3 p = ray.origin + t * ray.direction;
        const bool a = glm::length(p) < 1, b = glm::length(p - center) < 0.8f;
        return operation == SolidOperation::Union          ? a || b
               : operation == SolidOperation::Intersection ? a && b
                                                           : a && !b;
      };
      float expected = kInfinity;
      for (float t = 0; t < 8 && expected == kInfinity; t += 0.002f)
        if (inside(t) != inside(t + 0.002f)) expected = t;
      const Hit hit = w.rays->closest(ray, kMaskDiffuse);
      // A line that only grazes may miss the polygons.
      if (std::abs(hit.t - expected) < 0.05f || (hit.object < 0 && expected == kInfinity)) ++compared;
      // The normal points out of the solid.
      if (hit.object >= 0 && !inside(hit.t - 0.03f) && inside(hit.t + 0.03f)) {
        EXPECT_LT(dot(hit.geometricNormal, ray.direction), 0) << k;
      }
    }
    EXPECT_GT(compared, 388);
  }
}

TEST(SolidsForRays, TheHollowOfADifferenceFacesOutOfTheSolid) {
  Balls w(SolidOperation::Difference, vec3(0, 0, -1), 0.5f);
  w.build();
  const Hit hit = w.rays->closest({vec3(0, 0, -5), vec3(0, 0, 1)}, kMaskDiffuse);
  EXPECT_NEAR(hit.t, 4.5f, 0.01f);
  EXPECT_EQ(hit.object, 1);
  EXPECT_LT(hit.geometricNormal.z, -0.9f);
  EXPECT_LT(hit.normal.z, -0.9f);
}

TEST(SolidsForRays, LightPassesWhatIsTakenAway) {
  Balls w(SolidOperation::Difference, vec3(0, 0, 0), 1.5f);  // nothing is left
  w.build();
  EXPECT_EQ(w.transmission({vec3(0, 0, -5), vec3(0, 0, 1), 10}), vec3(1));
  Balls whole(SolidOperation::Union, vec3(0, 0, 0), 1.5f);
  whole.build();
  EXPECT_EQ(whole.transmission({vec3(0, 0, -5), vec3(0, 0, 1), 10}), vec3(0));
}

TEST(SolidsForRays, TransparentOnesAreCrossedTwiceHoweverManyParts) {
  Balls w(SolidOperation::Union, vec3(0.3f, 0, 0), 1);
  w.scene.objects[0].attributes = w.scene.objects[1].attributes = [] {
    auto a = std::make_shared<Attributes>();
    a->opacity = vec3(0.5f);
    return a;
  }();
  w.build();
  EXPECT_NEAR(w.transmission({vec3(0, 0.1f, -5), vec3(0, 0, 1), 10}).x, 0.25f, 1e-6f);
}

TEST(SolidsForRays, ARayLeavesTheirSurfaceWithoutMeetingIt) {
  Balls w(SolidOperation::Difference, vec3(0, 0, -1), 0.5f);
  w.build();
  // From the bottom of the hollow straight out, and into the other wall of it.
  EXPECT_EQ(w.rays->closest(w.rayFrom(1, vec3(0, 0, -0.5f), vec3(0, 0, -1)), kMaskDiffuse).object, -1);
  EXPECT_EQ(w.rays->closest(w.rayFrom(1, vec3(0, 0, -0.5f), vec3(1, 0, -0.3f)), kMaskDiffuse).object, 1);
}

TEST(SolidsForRays, PartsThatShareAShapeAreCutNevertheless) {
  World w;
  const PrimPtr sheet = waves();
  w.add(sheet, translation({0, 0, 5}));
  w.add(sheet, translation({0, 0, 6}));
  Solid solid;
  solid.add(SolidOperation::Union, -1);
  for (Object& o : w.scene.objects) {
    o.solid = 0;
    o.solidBlock = solid.add(SolidOperation::Primitive, 0);
  }
  w.scene.solids.push_back(solid);
  w.build();
  // What lies before the sheets is inside: the whole ends at the second.
  EXPECT_EQ(w.rays->closest({vec3(0.1f, 0.1f, 0), vec3(0, 0, 1)}, kMaskDiffuse).object, 1);
}

TEST(SolidsForRays, AreSeenBySidesAndGroupsAsOtherSurfacesAre) {
  Balls w(SolidOperation::Difference, vec3(0, 0, -1), 0.5f);
  w.build();
  Ray ray{vec3(0, 0, -5), vec3(0, 0, 1)};
  RayFilter filter;
  ray.filter = &filter;
  filter.sides = HitSides::Back;
  EXPECT_NEAR(w.rays->closest(ray, kMaskDiffuse).t, 6, 0.01f);
  std::vector<uint8_t> none(w.scene.groups.size(), 0);
  filter = {&none, HitSides::Both};
  EXPECT_EQ(w.rays->closest(ray, kMaskDiffuse).object, -1);
  EXPECT_EQ(w.transmission(ray), vec3(1));
}

/// Two balls in one place that fade into each other, a quarter and three quarters.
struct Fading : World {
  Fading() {
    attributes.detail = {0, 0.25f};
    add(sphere(1));
    attributes.detail = {0.25f, 1};
    add(sphere(1.02f));
    build();
  }
};

TEST(DetailForRays, EachRaySeesOneLevelInTheShareOfSamples) {
  const Fading w;
  int first = 0, hits = 0;
  for (uint32_t k = 0; k < 4000; ++k) {
    const vec3 d = cosineHemisphere({unitFloat(hash32(2 * k)), unitFloat(hash32(2 * k + 1))});
    const Hit hit = w.rays->closest({d * -5.0f, d}, kMaskDiffuse);
    hits += hit.object >= 0;
    first += hit.object == 0;
  }
  EXPECT_EQ(hits, 4000);
  EXPECT_NEAR(first / 4000.0, 0.25, 0.02);
}

TEST(DetailForRays, LevelsThatShareAShapeFadeToo) {
  World w;
  const PrimPtr sheet = waves();
  w.attributes.detail = {0, 0.25f};
  w.add(sheet, translation({0, 0, 5}));
  w.attributes.detail = {0.25f, 1};
  w.add(sheet, translation({0, 0, 6}));
  w.build();
  int first = 0;
  for (uint32_t k = 0; k < 4000; ++k) {
    const vec3 origin(unitFloat(hash32(2 * k)) - 0.5f, unitFloat(hash32(2 * k + 1)) - 0.5f, 0);
    first += w.rays->closest({origin, vec3(0, 0, 1)}, kMaskDiffuse).object == 0;
  }
  EXPECT_NEAR(first / 4000.0, 0.25, 0.02);
}

TEST(DetailForRays, OneLevelDoesNotShadowTheOtherInItsPlace) {
  const Fading w;
  for (uint32_t k = 0; k < 500; ++k) {
    const vec3 d = cosineHemisphere({unitFloat(hash32(2 * k)), unitFloat(hash32(2 * k + 1))});
    EXPECT_EQ(w.transmission(w.rayFrom(0, d, d)), vec3(1));
  }
}

}  // namespace
}  // namespace tomales::test
