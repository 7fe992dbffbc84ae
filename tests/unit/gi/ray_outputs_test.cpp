// What a shader's ray brings back from its hit, and what decides it: each against the value that the scene was given.
#include <gtest/gtest.h>

#include "fixture.h"

namespace tomales::test {
namespace {

Attributes& attributes(SceneBuilder& b) { return const_cast<Attributes&>(*b.scene.objects.back().attributes); }

/// Across the z axis, facing the origin.
void sheet(SceneBuilder& b, float z, const vec3& color, float opacity = 1) {
  b.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}, color);
  attributes(b).surface = std::make_shared<ShaderCall>(call("constant"));
  attributes(b).opacity = vec3(opacity);
}

constexpr float kUntouched = -7;

/// One ray along +z from a point of group 0, and its answers.
struct Shot {
  vec3 color{0}, opacity{0};
  float distance = 0;
  std::map<std::string, vec3> outputs;

  Shot(const GiServices& services, const vec3& from, const RayQuery& query,
       std::vector<std::pair<std::string, int>> names = {}, const ShadeContext& context = {}) {
    ShadePoints points(0, 0);
    const int i = points.add(5U);
    points.set3(kPx, i, from);
    points.set3(kNx, i, {0, 0, 1});
    points.set3(kNgx, i, {0, 0, 1});
    points.set3(kIx, i, {0, 0, -1});
    RayResult result;
    result.distance = &distance;
    result.color = {&color.x, &color.y, &color.z};
    result.opacity = {&opacity.x, &opacity.y, &opacity.z};
    for (const auto& [name, floats] : names) {
      vec3& value = outputs[name];
      value = vec3(kUntouched);
      result.outputs.push_back({name, floats, {&value.x, &value.y, &value.z}});
    }
    const uint8_t active = 1;
    const vec3 toward(0, 0, 1);
    services.trace(points, &active, {&from.x, &from.y, &from.z}, {&toward.x, &toward.y, &toward.z}, query, context,
                   result);
  }
};

void expectNear(const vec3& is, const vec3& expected, const char* what) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(is[k], expected[k], 1e-5f) << what << "[" << k << "]";
}

TEST(RayOutputs, AreWhatTheSceneSaysOfThePlaceThatIsMet) {
  SceneBuilder b;
  Problems problems;
  // 4 x 2 around the z axis at z = 3: u along x, v along y; a number and a colour that grow along u, and st of its own.
  Param P{"P", Storage::Vertex, ValueType::Point, 1, {-2, -1, 3, 2, -1, 3, -2, 1, 3, 2, 1, 3}, {}, {}};
  Param wet{"wet", Storage::Varying, ValueType::Float, 1, {0, 1, 0, 1}, {}, {}};
  Param Cs{"Cs", Storage::Varying, ValueType::Color, 1, {0, 0.5f, 0, 1, 0.5f, 0, 0, 0.5f, 1, 1, 0.5f, 1}, {}, {}};
  Param st{"st", Storage::Varying, ValueType::Float, 2, {10, 20, 12, 20, 10, 24, 12, 24}, {}, {}};
  b.add(makeBilinearPatchMesh(2, false, 2, false, {P, wet, Cs, st}, problems), vec3(1));
  attributes(b).surface = std::make_shared<ShaderCall>(call("constant"));
  attributes(b).opacity = {0.25f, 0.5f, 1};
  attributes(b).user["user:shot"] = floatParam("user:shot", 42);
  World world(b.scene);
  const auto services = world.use({});
  const vec3 from(0.4f, -0.5f, 0.5f), at(0.4f, -0.5f, 3);
  const float u = 0.6f, v = 0.25f;
  const Shot shot(*services, from, {},
                  {{"surface:Ci", 3},
                   {"surface:Oi", 3},
                   {"primitive:P", 3},
                   {"primitive:N", 3},
                   {"primitive:Ng", 3},
                   {"primitive:I", 3},
                   {"primitive:dPdu", 3},
                   {"primitive:dPdv", 3},
                   {"primitive:u", 1},
                   {"primitive:v", 1},
                   {"primitive:s", 1},
                   {"primitive:t", 1},
                   {"primitive:Cs", 3},
                   {"primitive:Os", 3},
                   {"primitive:wet", 1},
                   {"attribute:user:shot", 1},
                   {"primitive:dry", 1}});
  const auto is = [&](const char* name, const vec3& expected) { expectNear(shot.outputs.at(name), expected, name); };
  const auto number = [&](const char* name, float expected) {
    EXPECT_NEAR(shot.outputs.at(name).x, expected, 1e-5f) << name;
  };
  const vec3 color(u, 0.5f, v), opacity(0.25f, 0.5f, 1);
  EXPECT_NEAR(shot.distance, 2.5f, 1e-5f);
  is("surface:Ci", color * opacity);
  is("surface:Oi", opacity);
  is("primitive:P", at);
  is("primitive:I", at - from);
  EXPECT_NEAR(std::abs(shot.outputs.at("primitive:N").z), 1, 1e-5f);
  EXPECT_NEAR(std::abs(shot.outputs.at("primitive:Ng").z), 1, 1e-5f);
  is("primitive:dPdu", {4, 0, 0});
  is("primitive:dPdv", {0, 2, 0});
  number("primitive:u", u);
  number("primitive:v", v);
  number("primitive:s", 10 + 2 * u);
  number("primitive:t", 20 + 4 * v);
  is("primitive:Cs", color);
  is("primitive:Os", opacity);
  number("primitive:wet", u);
  number("attribute:user:shot", 42);
  number("primitive:dry", kUntouched);
  EXPECT_EQ(Shot(*services, {5, 0, 0}, {}, {{"primitive:u", 1}}).outputs.at("primitive:u").x, kUntouched)
      << "a miss sets nothing";
}

TEST(RayOutputs, AreTheOutputsOfTheShaderThatIsMetAndOfNoOther) {
  const vec3 color(0.2f, 0.4f, 0.8f);
  for (const std::string name : {"plastic", "matte"}) {
    SceneBuilder b;
    sheet(b, 2, color);
    attributes(b).surface = std::make_shared<ShaderCall>(call(name));
    World world(b.scene);
    const auto services = world.use({});
    const Shot shot(
        *services, vec3(0), {},
        {{"surface:albedo", 1}, {"primitive:P", 3}, {"surface:albedo", 3}, {"surface:nothing", 3}, {"surface:Oi", 3}});
    EXPECT_NEAR(shot.outputs.at("primitive:P").z, 2, 1e-5f) << name;
    expectNear(shot.outputs.at("surface:albedo"), name == "plastic" ? color : vec3(kUntouched), name.c_str());
    EXPECT_EQ(shot.outputs.at("surface:nothing").x, kUntouched) << name;
    expectNear(shot.outputs.at("surface:Oi"), vec3(1), name.c_str());
    RayQuery bare;
    bare.mode = HitMode::Primitive;
    EXPECT_EQ(Shot(*services, vec3(0), bare, {{"surface:albedo", 3}}).outputs.at("surface:albedo").x, kUntouched)
        << "no shader ran";
  }
}

TEST(RayOutputs, TheShaderRunsWhereTheCallOrElseTheAttributesOfTheObjectSaySo) {
  for (const HitMode own : {HitMode::Primitive, HitMode::Shader}) {
    SceneBuilder b;
    sheet(b, 2, {0.2f, 0.4f, 0.8f});
    attributes(b).surface = std::make_shared<ShaderCall>(call("matte"));  // black without light
    attributes(b).diffuseHitMode = own;
    attributes(b).specularHitMode = own == HitMode::Shader ? HitMode::Primitive : HitMode::Shader;
    World world(b.scene);
    const auto services = world.use({});
    for (const RayKind kind : {RayKind::Diffuse, RayKind::Specular}) {
      RayQuery query;
      query.kind = kind;
      const vec3 plain(0.2f, 0.4f, 0.8f);
      const bool runs = (own == HitMode::Shader) == (kind == RayKind::Diffuse);
      expectNear(Shot(*services, vec3(0), query).color, runs ? vec3(0) : plain, "by the attributes");
      query.mode = HitMode::Primitive;
      expectNear(Shot(*services, vec3(0), query).color, plain, "primitive");
      query.mode = HitMode::Shader;
      expectNear(Shot(*services, vec3(0), query).color, vec3(0), "shader");
    }
  }
}

TEST(RayOutputs, ARayGoesOnUntilEnoughIsCovered) {
  SceneBuilder b;
  for (const float z : {1.0f, 2.0f, 3.0f, 4.0f}) sheet(b, z, vec3(1), 0.5f);
  World world(b.scene);
  const auto services = world.use({});
  for (const auto& [threshold, layers] :
       {std::pair(0.0f, 1), {0.5f, 1}, {0.51f, 2}, {0.75f, 2}, {0.8f, 3}, {1.0f, 4}}) {
    RayQuery query;
    query.opacityThreshold = threshold;
    const Shot shot(*services, vec3(0), query);
    EXPECT_NEAR(shot.opacity.x, 1 - std::pow(0.5f, static_cast<float>(layers)), 1e-5f) << threshold;
    EXPECT_NEAR(shot.color.x, shot.opacity.x, 1e-5f) << "white";
    EXPECT_NEAR(shot.distance, 1, 1e-5f);
  }
}

TEST(RayOutputs, DiffuseRaysAreAsDeepAsTheObjectsOnTheWayAllow) {
  for (const int limit : {0, 1, 3}) {
    SceneBuilder b;
    sheet(b, 2, vec3(1));
    attributes(b).trace.maxDiffuseDepth = limit;
    World world(b.scene);
    const auto services = world.use({});
    RayQuery query;
    query.kind = RayKind::Diffuse;
    for (int depth = 0; depth < 5; ++depth) {
      ShadeContext context;  // of a point that a ray of this depth has met, whose path allows two more
      context.diffuseDepth = depth;
      context.diffuseLimit = depth + 2;
      EXPECT_EQ(Shot(*services, vec3(0), query, {}, context).distance < kInfinity, limit >= 1)
          << "limit " << limit << ", depth " << depth;
      context.diffuseLimit = depth;
      EXPECT_EQ(Shot(*services, vec3(0), query, {}, context).distance, kInfinity) << "an earlier limit is not lifted";
    }
  }
}

TEST(RayOutputs, DisplacementIsMetWhereTheObjectAsksForIt) {
  for (const bool displaced : {false, true}) {
    SceneBuilder b(256);
    b.quad({-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}, vec3(1));
    attributes(b).displacement = std::make_shared<ShaderCall>(call("noisybump", {floatParam("Km", 0.2f)}));
    attributes(b).displacementBound = 0.2f;
    attributes(b).trace.displacements = displaced;
    attributes(b).trace.tessellation = 16;
    World world(b.scene);
    Grid truth = diceAtOpen(world.scene, 0, 0, UvRect{}, 64, 64);
    world.shading.displace(truth);
    float farthest = 0;
    for (int k = 0; k < truth.vertexCount(); ++k) {
      const vec3 P = truth.position(0, k);
      if (std::max(std::abs(P.x), std::abs(P.y)) > 0.99f) continue;
      const Hit hit = world.rays.closest({{P.x, P.y, 0}, {0, 0, 1}}, kMaskSpecular);
      ASSERT_EQ(hit.object, 0);
      EXPECT_NEAR(hit.t, displaced ? P.z : 3, displaced ? 0.01f : 1e-5f);
      farthest = std::max(farthest, std::abs(P.z - 3));
    }
    EXPECT_GT(farthest, 0.05f);
  }
}

}  // namespace
}  // namespace tomales::test
