// Cones, sums and questions of the ray-traced calls, with rays that are functions.
#include "reyes/shader.h"
#include "stage.h"

namespace tomales {
namespace ray_services {
namespace {

// These are settings of the one test shader, which runs on the test's thread.
TmRayOptions options = tmRayDefaults();
TmOcclusion falloff = tmOcclusionDefaults();
enum class Ask { Occlusion, Trace, Gather, Info } ask;

void probe(const TmGrid* g) {
  const rsl::Batch b(g);
  rsl::Vec3Array N(g), out(g);
  for (int i : b) N.set(i, b.N(i));
  if (ask == Ask::Occlusion) {
    const rsl::Array covered = b.occlusion(N, options, falloff);
    for (int i : b) out.set(i, {covered[i], 0, 0});
  } else if (ask == Ask::Trace) {
    const rsl::Array distance = b.traceDistance(N, options);
    for (int i : b) out.set(i, {distance[i], 0, 0});
  } else if (ask == Ask::Gather) {
    std::vector<uint8_t> hit;
    rsl::Array length(g);
    for (int ray = 0; b.gather(N, options, ray, hit, {{"ray:length", {length.data(), nullptr, nullptr}}}); ++ray)
      for (int i : b) out.set(i, out[i] + rsl::Vec3{hit[static_cast<size_t>(i)] ? length[i] : 0, 1, 0});
  } else {
    rsl::Vec3Array type(g), depth(g);
    g->call->rayInfo(g->host, g, "type", type);
    g->call->rayInfo(g->host, g, "depth", depth);
    const float label = std::string(g->call->rayLabel(g->host, g)) == "here";
    for (int i : b) out.set(i, {type[i].x, depth[i].x, label});
  }
  for (int i : b) b.output(i, out[i], {1, 1, 1});
}

const rsl::Shader probeShader(TM_SURFACE, "probe", "", TM_KEEPS_OPACITY | TM_TRACES, probe, {});

class RayServices : public Stage {
 protected:
  RayServices() {
    static const TmShader* const shaders[] = {probeShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    surface("probe");
    options = tmRayDefaults();
    falloff = tmOcclusionDefaults();
  }
  /// Points all alike look along -z; their results are averaged.
  vec3 mean(Ask question, int points_ = 16, const ShadeContext& context = {}) {
    ask = question;
    const ShadedPoints out = shade(points(std::vector<vec3>(static_cast<size_t>(points_), vec3(0, 0, 5))), context);
    vec3 sum(0);
    for (int i = 0; i < points_; ++i) sum += out.color(i) / static_cast<float>(points_);
    return sum;
  }
};

TEST_F(RayServices, ACosineConeFillsItsProjectedDiskAndAUniformOneItsSolidAngle) {
  options.coneAngle = 1.0f;
  options.samples = 256;
  for (const bool uniform : {false, true}) {
    options.uniform = uniform;
    const float half = 0.5f;  // what lies within half of the angle is met
    services.met = [&](const vec3&, const vec3& d) {
      EXPECT_GT(-d.z, std::cos(1.0f) - 1e-4f);
      EXPECT_NEAR(glm::length(d), 1, 1e-5f);
      return -d.z > std::cos(half) ? 2.0f : kInfinity;
    };
    const double expected =
        uniform ? (1 - std::cos(half)) / (1 - std::cos(1.0)) : std::pow(std::sin(half) / std::sin(1.0), 2);
    EXPECT_NEAR(mean(Ask::Occlusion).x, expected, 0.003);
  }
}

TEST_F(RayServices, OcclusionFallsOffWithDistance) {
  services.met = [](const vec3&, const vec3&) { return 2.0f; };
  EXPECT_NEAR(mean(Ask::Occlusion).x, 1, 1e-5f);
  falloff.falloff = 0.5f;
  EXPECT_NEAR(mean(Ask::Occlusion).x, std::exp(-1.0f), 1e-5f);
  falloff.falloffMode = 1;
  options.maxDistance = 8;
  falloff.falloff = 2;
  EXPECT_NEAR(mean(Ask::Occlusion).x, 0.5625f, 1e-5f);
}

TEST_F(RayServices, WideRaysAreDiffuseAndNarrowOnesSpecular) {
  for (const float angle : {0.0f, 0.17f, 0.18f}) {
    options.coneAngle = angle;
    mean(Ask::Trace, 1);
    EXPECT_EQ(services.asked.back().kind, angle > 0.175f ? RayKind::Diffuse : RayKind::Specular);
  }
  options.label = "here";
  options.subset = "a";
  options.excludeSubset = "b";
  options.hitSides = TM_HIT_BACK;
  options.hitMode = TM_HIT_PRIMITIVE;
  options.bias = 0.5f;
  options.maxDistance = 7;
  mean(Ask::Trace, 1);
  const RayQuery& q = services.asked.back();
  EXPECT_TRUE(q.label == "here" && q.subset == "a" && q.excludeSubset == "b" && q.sides == HitSides::Back &&
              q.mode == HitMode::Primitive && q.bias == 0.5f && q.maxDistance == 7);
}

TEST_F(RayServices, TraceTellsTheLeastDistanceAndGatherEveryOne) {
  options.samples = 10;
  options.coneAngle = 0.1f;
  int ray = 0;
  services.met = [&](const vec3&, const vec3&) { return ++ray % 2 ? 3.0f : kInfinity; };
  EXPECT_EQ(mean(Ask::Trace, 1).x, 3);
  const vec3 gathered = mean(Ask::Gather, 1);
  EXPECT_EQ(gathered.y, 10) << "as many rays as samples";
  EXPECT_EQ(gathered.x, 15) << "half of them met something";
  services.met = nullptr;
  EXPECT_EQ(mean(Ask::Trace, 1).x, 1e30f);
}

TEST_F(RayServices, APointKnowsTheRayThatCame) {
  EXPECT_EQ(mean(Ask::Info, 1), vec3(0));
  ShadeContext context;
  context.kind = RayKind::Specular;
  context.diffuseDepth = 1;
  context.specularDepth = 2;
  context.label = "here";
  EXPECT_EQ(mean(Ask::Info, 1, context), vec3(2, 3, 1));
}

TEST_F(RayServices, OptionsOfAnotherReleaseAreReadAsFarAsTheyGo) {
  options.structBytes = offsetof(TmRayOptions, maxDistance);
  options.bias = 0.5f;
  options.maxDistance = 5;
  mean(Ask::Trace, 1);
  EXPECT_EQ(services.asked.back().bias, 0.5f);
  EXPECT_EQ(services.asked.back().maxDistance, 1e30f) << "the default";
  struct Later {
    TmRayOptions known = tmRayDefaults();
    float more = 7;
  } later;
  later.known.structBytes = sizeof later;
  later.known.bias = 0.25f;
  options = later.known;
  mean(Ask::Trace, 1);
  EXPECT_EQ(services.asked.back().bias, 0.25f);
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(RayServices, OptionsThatNoFunctionOfDefaultsHasMadeAreReportedAndNotUsed) {
  options = TmRayOptions{};
  options.samples = 5;
  options.coneAngle = 0.1f;
  mean(Ask::Trace, 1);
  EXPECT_EQ(services.asked.size(), 1u) << "one ray, the default";
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.entries()[0].severity, Severity::Missing);
  EXPECT_NE(log.entries()[0].message.find("structBytes is 0"), std::string::npos) << log.entries()[0].message;
}

}  // namespace
}  // namespace ray_services
}  // namespace tomales
