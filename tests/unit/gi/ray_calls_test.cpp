// Compares what shaders trace with closed forms.
#include <gtest/gtest.h>

#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;

/// Changes the attributes of the object that was added last.
template <class Change>
void change(SceneBuilder& b, const Change& edit) {
  auto copy = std::make_shared<Attributes>(*b.scene.objects.back().attributes);
  edit(*copy);
  b.scene.objects.back().attributes = copy;
}

void surface(SceneBuilder& b, const std::string& name, ParamList params = {}) {
  change(b, [&](Attributes& a) { a.surface = std::make_shared<ShaderCall>(call(name, params)); });
}

/// A parallelogram whose colour at each place is `color` of its corners, in between bilinear.
void coloredQuad(SceneBuilder& b, const vec3 (&corner)[4], const vec3 (&color)[4], const char* name = "Cs") {
  Problems problems;
  Param P{"P", Storage::Vertex, ValueType::Point, 1, {}, {}, {}},
      C{name, Storage::Varying, ValueType::Color, 1, {}, {}, {}};
  for (const vec3& p : corner) P.floats.insert(P.floats.end(), {p.x, p.y, p.z});
  for (const vec3& c : color) C.floats.insert(C.floats.end(), {c.x, c.y, c.z});
  b.add(makeBilinearPatchMesh(2, false, 2, false, {P, C}, problems), vec3(1));
}

int addSeenPoint(ShadePoints& points, const vec3& P, const vec3& N, const vec3& I) {
  const int i = points.add(static_cast<uint32_t>(points.count()) * 7919u + 3);
  points.set3(kPx, i, P);
  points.set3(kNx, i, N);
  points.set3(kNgx, i, N);
  points.set3(kIx, i, I);
  return i;
}

std::vector<vec3> shaded(const World& world, const ShadePoints& points, const ShadeContext& context = {}) {
  ShadedPoints out;
  world.shading.shade(points, context, out);
  std::vector<vec3> colors;
  for (int i = 0; i < points.count(); ++i) colors.push_back(out.color(i));
  return colors;
}

template <class Edit>
RayQuery asking(const Edit& edit) {
  RayQuery query;
  edit(query);
  return query;
}

/// One ray from P along `direction`, from an object of group 0.
struct Answer {
  float distance = 0;
  vec3 color, opacity, place;
  float effective = 0;
  uint8_t leaves = 0;
};
Answer traceOne(const GiServices& services, const vec3& P, const vec3& direction, const RayQuery& query,
                const ShadeContext& context = {}) {
  ShadePoints points(0, 0);
  addSeenPoint(points, P, {0, 1, 0}, {0, -1, 0});
  const uint8_t active = 1;
  Answer a;
  const auto view = [](vec3& v) { return TmVec3{&v.x, &v.y, &v.z}; };
  const RayResult result{&a.distance,  view(a.color), view(a.opacity),
                         &a.effective, &a.leaves,     {{"primitive:P", 3, {&a.place.x, &a.place.y, &a.place.z}}}};
  services.trace(points, &active, {&P.x, &P.y, &P.z}, {&direction.x, &direction.y, &direction.z}, query, context,
                 result);
  return a;
}

TEST(RayCalls, AMirrorShowsThePlaceWhereTheReflectedRayArrives) {
  SceneBuilder b;
  b.quad({-5, 0, 0}, {5, 0, 0}, {5, 0, 10}, {-5, 0, 10}, vec3(1));
  surface(b, "mirror");
  // A wall at z = 10 whose colour is its place.
  const vec3 corners[4] = {{-9, 0, 10}, {9, 0, 10}, {-9, 9, 10}, {9, 9, 10}};
  coloredQuad(b, corners, corners);
  surface(b, "constant");
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints points(0, 0);
  std::vector<vec3> expected;
  const vec3 eye(0.3f, 2, -1);
  for (int k = 0; k < 50; ++k) {
    const vec3 P(-3 + 0.12f * static_cast<float>(k), 0, 4 + 0.05f * static_cast<float>(k)), I = P - eye,
                                                                                            R(I.x, -I.y, I.z);
    addSeenPoint(points, P, {0, 1, 0}, I);
    expected.push_back(P + R * ((10 - P.z) / R.z));
  }
  const std::vector<vec3> is = shaded(world, points);
  for (size_t k = 0; k < is.size(); ++k) EXPECT_LT(glm::length(is[k] - expected[k]), 2e-4f) << k;
}

TEST(RayCalls, AnEmitterThatAMirrorShowsCountsOnce) {
  SceneBuilder b;
  b.quad({-1, 0, 0}, {1, 0, 0}, {1, 0, 2}, {-1, 0, 2}, vec3(1));
  surface(b, "mirror");
  auto light = std::make_shared<LightCall>();
  light->shader = call("arealight", {floatParam("intensity", 3)});
  light->area = true;
  light->index = 0;
  b.scene.lights.push_back(light);
  change(b, [](Attributes& a) { a.lights = {0}; });
  b.quad({-9, 4, -9}, {-9, 4, 9}, {9, 4, 9}, {9, 4, -9}, vec3(0));
  surface(b, "constant");
  change(b, [](Attributes& a) { a.areaLight = 0; });
  for (const bool inside : {false, true}) {
    change(b, [&](Attributes& a) { a.insideOut = inside; });
    World world(b.scene);
    const auto services = world.use({});
    ShadePoints points(0, 0);
    addSeenPoint(points, {0, 0, 1}, {0, 1, 0}, {0.1f, -1, 0.2f});
    const float is = shaded(world, points)[0].x;
    EXPECT_TRUE(is == 3 || is == 0) << is;
    // One of its sides shines, and diffuse rays leave it to direct light.
    const float other =
        traceOne(*services, {0, 0, 1}, {0, 1, 0}, asking([&](RayQuery& q) { q.kind = RayKind::Diffuse; })).color.x;
    EXPECT_EQ(other, 0);
  }
}

TEST(RayCalls, AirBetweenLayersIsThatOfTheSideOnWhichTheRayLeavesEach) {
  // Sheets across a ray along +z, with fog inside and outside of each: the law of Beer and Lambert. Fog before the
  // first is the caller's.
  struct Sheet {
    float z, opacity;
    vec3 color;
    bool turned;
    float thick[2];  // distances of the fog outside, inside; 0: none
  };
  const Sheet sheets[] = {{2, 0.25f, {1, 0, 0}, false, {4, 7}},
                          {3, 0.5f, {0, 1, 0}, true, {5, 2}},
                          {4.5f, 0.75f, {0.5f, 0.5f, 1}, false, {0, 0}},
                          {7, 0.2f, {1, 1, 0}, true, {0, 6}},
                          {9, 1, vec3(1), false, {1, 1}}};
  const vec3 fog(0.2f, 0.4f, 0.8f);
  for (const bool flipped : {false, true}) {
    SceneBuilder b;
    for (const Sheet& s : sheets) {
      b.quad({-1, -1, s.z}, {1, -1, s.z}, {1, 1, s.z}, {-1, 1, s.z}, s.color);
      surface(b, "constant");
      change(b, [&](Attributes& a) {
        a.opacity = vec3(s.opacity);
        a.insideOut = s.turned != flipped;
        const auto volume = [&](float distance) {
          Param background{"background", Storage::Uniform, ValueType::Color, 1, {fog.x, fog.y, fog.z}, {}, {}};
          return distance > 0
                     ? std::make_shared<ShaderCall>(call("fog", {floatParam("distance", distance), background}))
                     : nullptr;
        };
        a.exterior = volume(s.thick[0]);
        a.interior = volume(s.thick[1]);
      });
    }
    World world(b.scene);
    const auto services = world.use({});
    const Hit first = world.rays.closest({vec3(0), {0, 0, 1}}, kMaskSpecular);
    const bool entersFirst = first.geometricNormal.z < 0;  // every other sheet by whether it is turned
    vec3 color(0);
    float clear = 1, before = 0;
    const Sheet* last = nullptr;
    for (const Sheet& s : sheets) {
      const float distance = last ? last->thick[entersFirst != last->turned] : 0,
                  passes = distance > 0 ? std::exp((before - s.z) / distance) : 1;
      color += clear * ((1 - passes) * fog + passes * s.opacity * s.color);
      clear *= passes * (1 - s.opacity);
      before = s.z;
      last = &s;
    }
    const Answer is = traceOne(*services, vec3(0), {0, 0, 1}, {});
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(is.color[k], color[k], 1e-5f) << "channel " << k << (flipped ? ", flipped" : "");
    EXPECT_NEAR(is.distance, 2, 1e-5f);
  }
}

TEST(RayCalls, LightPassesLayersByTheProductOfTheirClearness) {
  for (const bool byPrimvar : {false, true}) {
    SceneBuilder b;
    b.quad({-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}, vec3(1));
    const int layers = 7;
    for (int k = 1; k <= layers; ++k) {
      const float y = 0.5f * static_cast<float>(k);
      if (byPrimvar) {
        const vec3 o(0.2f, 0.4f, 0.6f);
        coloredQuad(b, {{-3, y, -3}, {3, y, -3}, {-3, y, 3}, {3, y, 3}}, {o, o, o, o}, "Os");
      } else {
        b.quad({-3, y, -3}, {3, y, -3}, {3, y, 3}, {-3, y, 3}, vec3(1));
        change(b, [](Attributes& a) { a.opacity = {0.2f, 0.4f, 0.6f}; });
      }
    }
    World world(b.scene);
    const auto services = world.use({});
    for (const int through : {0, 1, 4, 7}) {
      ShadePoints points(0, 0);
      addSeenPoint(points, {0.3f, 0, 0.1f}, {0, 1, 0}, {0, -1, 0});
      const uint8_t active = 1;
      const vec3 toward(0, 0.5f * static_cast<float>(through) + 0.25f, 0);
      vec3 light(1);
      services->transmission(points, &active, {&toward.x, &toward.y, &toward.z}, {}, {},
                             {&light.x, &light.y, &light.z});
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(light[c], std::pow(0.8f - 0.2f * static_cast<float>(c), static_cast<float>(through)), 1e-5f);
      // A ray that brings colour goes through them too.
      const Answer a = traceOne(*services, {0.3f, 0, 0.1f}, {0, 1, 0}, asking([&](RayQuery& q) {
        q.maxDistance = toward.y;
        q.mode = HitMode::Primitive;
      }));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(1 - a.opacity[c], std::pow(0.8f - 0.2f * static_cast<float>(c), static_cast<float>(through)),
                    1e-5f);
      EXPECT_LT(glm::length(a.color - a.opacity), 1e-5f) << "white layers: what covers is what shines";
      EXPECT_EQ(a.leaves, 1) << "nothing that is met is opaque";
      // The mean distance of layers 1/2 apart, by what each covers: the mean over the colours.
      double covered = 0, distances = 0;
      for (int k = 1; k <= through; ++k)
        for (const double clear : {0.8, 0.6, 0.4}) {
          covered += (1 - clear) * std::pow(clear, k - 1);
          distances += 0.5 * k * (1 - clear) * std::pow(clear, k - 1);
        }
      if (through > 0) {
        EXPECT_NEAR(a.effective, distances / covered, 1e-4);
      } else
        EXPECT_EQ(a.effective, kInfinity);
    }
  }
}

TEST(RayCalls, OcclusionOfASphereOnAPlaneIsItsFormFactor) {
  SceneBuilder b;
  b.light("occlusionlight", {floatParam("samples", 4096)});
  b.quad({-90, 0, -90}, {90, 0, -90}, {90, 0, 90}, {-90, 0, 90}, vec3(1));
  b.sphere(1, vec3(1), {0, 1, 5});
  change(b, [](Attributes& a) { a.trace.tessellation = 8; });
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints points(0, 0);
  std::vector<float> expected;
  for (int k = 0; k < 12; ++k) {
    const float d = 0.5f + 0.25f * static_cast<float>(k);
    addSeenPoint(points, {d, 0, 5}, {0, 1, 0}, {0, -1, 0});
    // Form factor of a sphere that touches the horizon: (r / D)^2 cos.
    expected.push_back(1 - std::pow(1 / std::sqrt(1 + d * d), 3.0f));
  }
  const std::vector<vec3> is = shaded(world, points);
  for (size_t k = 0; k < is.size(); ++k) EXPECT_NEAR(is[k].x / expected[k], 1, 0.005f) << k;
}

TEST(RayCalls, OcclusionInARightAngledCornerIsThatOfAnEndlessWall) {
  SceneBuilder b;
  b.light("occlusionlight", {floatParam("samples", 4096)});
  b.quad({0, 0, -2000}, {2000, 0, -2000}, {2000, 0, 2000}, {0, 0, 2000}, vec3(1));
  const float height = 2;
  b.quad({0, 0, -2000}, {0, 0, 2000}, {0, height, 2000}, {0, height, -2000}, vec3(1));
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints points(0, 0);
  std::vector<float> expected;
  for (const float x : {0.01f, 0.1f, 0.5f, 1.0f, 2.0f, 5.0f}) {
    addSeenPoint(points, {x, 0, 5}, {0, 1, 0}, {0, -1, 0});
    // An endless wall covers half of 1 less the sine of the angle between its top and the vertical.
    expected.push_back(1 - 0.5f * (1 - x / std::hypot(x, height)));
  }
  const std::vector<vec3> is = shaded(world, points);
  for (size_t k = 0; k < is.size(); ++k) EXPECT_NEAR(is[k].x / expected[k], 1, 0.005f) << k;
}

TEST(RayCalls, SubsetsAndSidesAndDistanceChooseWhatIsMet) {
  SceneBuilder b;
  b.quad({-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}, vec3(1));
  for (int k = 1; k <= 3; ++k) {
    const float y = static_cast<float>(k);
    b.quad({-3, y, -3}, {3, y, -3}, {3, y, 3}, {-3, y, 3}, vec3(1));
    change(b, [&](Attributes& a) {
      a.membership = {k == 1 ? "near" : "far", "all"};
      a.insideOut = k == 2;
    });
  }
  World world(b.scene);
  const auto services = world.use({});
  const vec3 P(0.2f, 0, 0.1f), up(0, 1, 0);
  const auto distance = [&](const RayQuery& q) { return traceOne(*services, P, up, q).distance; };
  EXPECT_NEAR(distance({}), 1, 1e-5f);
  EXPECT_NEAR(distance(asking([&](RayQuery& q) { q.subset = "far"; })), 2, 1e-5f);
  EXPECT_NEAR(distance(asking([&](RayQuery& q) {
                q.subset = "all";
                q.excludeSubset = "near";
              })),
              2, 1e-5f);
  EXPECT_NEAR(distance(asking([&](RayQuery& q) { q.subset = "near, far"; })), 1, 1e-5f);
  EXPECT_EQ(distance(asking([&](RayQuery& q) { q.subset = "fa"; })), kInfinity);
  EXPECT_EQ(distance(asking([&](RayQuery& q) { q.maxDistance = 0.9f; })), kInfinity);
  const float front = distance(asking([&](RayQuery&q) { q.sides = HitSides::Front; })),
              back = distance(asking([&](RayQuery&q) { q.sides = HitSides::Back; }));
  EXPECT_NEAR(std::min(front, back), 1, 1e-5f);
  EXPECT_NEAR(std::max(front, back), 2, 1e-5f);
  EXPECT_LT(glm::length(traceOne(*services, P, up, asking([&](RayQuery& q) { q.subset = "far"; })).place -
                        vec3(0.2f, 2, 0.1f)),
            1e-5f);
}

// In a white sky everything that neither absorbs nor casts shadows is white: mirrors, and glass whose rays go on until
// they leave.
TEST(RayCalls, GlassAndMirrorsAreAsBrightAsTheSkyAroundThem) {
  SceneBuilder b;
  b.light("environmentlight", {floatParam("intensity", 3)});
  b.sphere(1, vec3(1), {0, 0, 5});
  surface(b, "glass");
  change(b, [](Attributes& a) { a.trace.maxSpecularDepth = 100; });
  b.sphere(1, vec3(1), {3, 0, 5});
  surface(b, "mirror");
  change(b, [](Attributes& a) { a.trace.maxSpecularDepth = 100; });
  b.scene.options.maxRayDepth = 100;
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints glass(0, 0), mirror(1, 0);
  for (int k = 0; k < 20; ++k) {
    const float x = 0.045f * static_cast<float>(k), z = -std::sqrt(1 - x * x);
    addSeenPoint(glass, vec3(x, 0, z) + vec3(0, 0, 5), {x, 0, z}, vec3(x, 0, 5 + z));
    addSeenPoint(mirror, vec3(-x, 0, z) + vec3(3, 0, 5), {-x, 0, z}, {0, 0, 1});
  }
  // Within glass weak reflections are left out with their share: nothing is lost.
  for (const vec3& c : shaded(world, glass)) EXPECT_NEAR(c.y, 3, 0.02f);

  for (const vec3& c : shaded(world, mirror)) EXPECT_NEAR(c.y, 3, 0.02f);
}

TEST(RayCalls, RaysThatAreNotShotDoNotLeave) {
  SceneBuilder b;
  b.light("environmentlight", {});
  b.quad({-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}, vec3(1));
  surface(b, "mirror");
  change(b, [](Attributes& a) { a.trace.maxSpecularDepth = 0; });
  World world(b.scene);
  const auto services = world.use({});
  ShadePoints points(0, 0);
  addSeenPoint(points, {0, 0, 0}, {0, 1, 0}, {0.01f, -1, 0});
  EXPECT_EQ(shaded(world, points)[0], vec3(0));
}

TEST(RayCalls, DepthIsLimitedByTheObjectsOnTheWay) {
  // Two mirrors face each other; both are black where the limit ends the path, so count the rays.
  const auto raysOf = [](int first, int second) {
    SceneBuilder b;
    b.quad({-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}, vec3(1));
    surface(b, "mirror");
    change(b, [&](Attributes& a) { a.trace.maxSpecularDepth = first; });
    b.quad({-9, 1, -9}, {9, 1, -9}, {9, 1, 9}, {-9, 1, 9}, vec3(1));
    surface(b, "mirror");
    change(b, [&](Attributes& a) { a.trace.maxSpecularDepth = second; });
    World world(b.scene);
    const auto services = world.use({});
    ShadePoints points(0, 0);
    addSeenPoint(points, {0, 0, 0}, {0, 1, 0}, {0.01f, -1, 0});
    shaded(world, points);
    return world.stats.rays.specular.load();
  };
  EXPECT_EQ(raysOf(0, 9), 0);
  EXPECT_EQ(raysOf(2, 9), 2) << "the first object limits all that follows";
  EXPECT_EQ(raysOf(9, 1), 2) << "one ray leaves the second";
  EXPECT_EQ(raysOf(100, 100), 10) << "Option trace maxdepth";
}

}  // namespace
}  // namespace tomales
