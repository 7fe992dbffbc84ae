// Rays of shaders in RSL's manner (reyes/shader/sl_light.h): what they are asked, what they tell, how wide they are.
#include "tests/unit/shade/bare_services.h"
#include "tests/unit/shade/obedient.h"
#include "tests/unit/shade/written_picture.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

using namespace sl;

class BatchRays : public BatchServices {};

/// A latitude-longitude picture whose texels hold 1 + their direction.
std::string pictureOfDirections(const std::string& name) {
  return writePicture(test::temporary(name), 256, 128, "RGB", [](int x, int y) {
    const float theta = kPi * (static_cast<float>(y) + 0.5f) / 128,
                phi = 2 * kPi * (static_cast<float>(x) + 0.5f) / 256;
    return std::array{1 + std::sin(theta) * std::cos(phi), 1 + std::sin(theta) * std::sin(phi), 1 + std::cos(theta)};
  });
}

TEST_F(BatchRays, IndirectdiffuseIsTheMeanOfWhatRaysSee) {
  services.seen = [](const vec3& d) { return vec3(2, d.z * d.z, 1); };
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) { s.Ci = indirectdiffuse(s.P, s.N, 4096); });
  expectColor(c[0], vec3(2, 0.5f, 1), 0.01f);  // the mean of cos^2 by the cosine is 1/2
  EXPECT_EQ(asked(2, [](sl::Surface& s) { s.Ci = indirect(s.P, s.N, 4096); })[0], c[0]) << "its old name";
}

TEST_F(BatchRays, PointsThatAShaderHasMovedAreTracedAndTheOthersInterpolated) {
  services.interpolated = 0.75f;
  services.met = [](const vec3&, const vec3&) { return 1.0f; };
  const std::vector<vec3> c = asked(8, [](sl::Surface& s) {
    Point from = s.P;
    sl::If(s.u > 0.3, [&] { from += Vector(0, 0.5, 0); });
    s.Ci = Color(occlusion(from, s.N, 4, "maxvariation", 0.1), occlusion(from, s.N, 4), 0);
  });
  for (const size_t i : {0u, 1u, 2u}) expectColor(c[i], {0.75f, 1, 0});
  expectColor(c[3], {1, 1, 0});
}

// Half of the sphere of directions leaves the scene, towards +x; the map is 1 + its own direction.
TEST_F(BatchRays, OcclusionTellsOfTheEnvironmentWhereRaysLeave) {
  const std::string path = pictureOfDirections("tomales_open.exr");
  services.met = [](const vec3&, const vec3& d) { return d.x > 0 ? kInfinity : 1.0f; };
  services.seen = [](const vec3& d) { return d.x > 0 ? vec3(0) : vec3(0, 0, 2); };
  const std::vector<vec3> c = asked(2, [&](sl::Surface& s) {
    Color environmentColor, environmentDirection;
    Float covers;
    Color radiance = indirectdiffuse(s.P, Normal(0, 0, 1), 4096, "environmentmap", path.c_str(), "environmentcolor",
                                     &environmentColor, "environmentdir", &environmentDirection, "occlusion", &covers);
    s.Ci = radiance;
    EXPECT_NEAR(covers[0], 0.5f, 2e-3f);
    // By the cosine, the mean of x over the half of the hemisphere where it is positive is 2/(3 pi), of z 1/3, of y 0;
    // each over all.
    const float x = 2.0f / (3 * kPi), z = 1.0f / 3;
    EXPECT_NEAR(environmentColor[0].x, 0.5f + x, 0.01f);
    EXPECT_NEAR(environmentColor[0].y, 0.5f, 0.01f);
    EXPECT_NEAR(environmentColor[0].z, 0.5f + z, 0.01f);
    const vec3 mean = glm::normalize(vec3(x, 0, z));
    expectColor({environmentDirection[0].x, environmentDirection[0].y, environmentDirection[0].z}, mean, 0.01f);
  });
  EXPECT_NEAR(c[0].z, 1 + 0.5f + 1.0f / 3, 0.01f);
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchRays, BeginAtTheirPointOrAllOverItsMicropolygon) {
  std::vector<vec3> from;
  services.met = [&](const vec3& P, const vec3&) {
    from.push_back(P);
    return 1.0f;
  };
  ShadePoints p = points({vec3(0, 0, 5)});
  p.set3(kDpduX, 0, {2, 0, 0});
  p.set3(kDpdvX, 0, {0, 3, 0});
  p.channel(kDu)[0] = 0.5f;
  p.channel(kDv)[0] = 0.2f;
  constexpr int kRays = 1024;
  const auto shoot = [&](double base) {
    from.clear();
    body = [base](sl::Surface& s) { s.Ci = Color(occlusion(s.P, s.N, kRays, "samplebase", base)); };
    shade(p);
    ASSERT_EQ(from.size(), static_cast<size_t>(kRays));
  };
  shoot(0);
  for (const vec3& P : from) EXPECT_EQ(P, vec3(0, 0, 5));
  shoot(0.5);
  vec3 mean(0), square(0);
  for (const vec3& P : from) {
    mean += P / static_cast<float>(kRays);
    square += (P - vec3(0, 0, 5)) * (P - vec3(0, 0, 5)) / static_cast<float>(kRays);
  }
  // Half of the edges 1 and 0.6 of the micropolygon: numbers that are even over a width w have the variance w^2 / 12.
  expectColor(mean, {0, 0, 5}, 1e-3f);
  expectColor(square, {0.25f / 12, 0.09f / 12, 0}, 1e-4f);
}

TEST_F(BatchRays, OfEveryDepthGoTheirOwnWays) {
  const auto seen = [&](int diffuse, int specular) {
    vec3 first(0);
    services.seen = [&](const vec3& d) { return first = d; };
    ShadeContext context;
    context.diffuseDepth = diffuse;
    context.specularDepth = specular;
    asked(
        2, [](sl::Surface& s) { s.Ci = trace(s.P, s.N, "samplecone", 0.5, "samples", 1); }, context);
    return first;
  };
  EXPECT_EQ(seen(0, 0), seen(0, 0));
  EXPECT_NE(seen(0, 0), seen(1, 0));
  EXPECT_NE(seen(0, 0), seen(0, 1));
  EXPECT_NE(seen(0, 0), seen(1, 1));
  EXPECT_EQ(seen(2, 0), seen(1, 1)) << "it is their sum that counts";
}

TEST_F(BatchRays, GatherBeyondTheLimitOfDepthMeetsNothingAndTracesNothing) {
  services.met = [](const vec3&, const vec3&) { return 3.0f; };
  services.deep = true;
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) {
    Float hits = 0, far = 0, length = 7;
    gather(
        "illuminance", s.P, s.N, 0.5f, 4, rays(), {{"ray:length", &length}}, [&] { hits += 1; },
        [&] { far += step(1e20f, length); });
    s.Ci = Color(hits, far, 0);
  });
  expectColor(c[0], {0, 4, 0});
  EXPECT_TRUE(services.asked.empty());
}

TEST_F(BatchRays, GatherHasCategoriesListsAndTheEffectiveDistance) {
  services.met = [](const vec3&, const vec3&) { return 3.0f; };
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) {
    Float hits = 0, misses = 0, effective, length;
    Vector direction, sum;
    gather(
        "illuminance", s.P, s.N, 0.5f, 4, rays("label", "probe", "distribution", "cosine"),
        {{"effectivedistance", &effective}, {"ray:length", &length}}, [&] { hits += effective + 10 * length; },
        [&] { misses += 1; });
    s.Ci = Color(hits, misses, 0);
    gather(
        "samplepattern", s.P, s.N, 0.5f, 8, rays(), {{"ray:direction", &direction}}, [&] { hits += 1000; },
        [&] { sum += direction; });
    setzcomp(s.Ci, zcomp(normalize(sum)));
  });
  expectColor(c[0], {4 * 36, 0, -1}, 0.05f);
  EXPECT_EQ(services.asked.front().label, "probe");
  EXPECT_EQ(services.asked.size(), 4u) << "a pattern of samples is not traced";
  body = [](sl::Surface& s) {
    gather(
        "pathtrace", s.P, s.N, 0.5f, 4, rays(), {}, [] {}, [] {});
  };
  shadeOne();
  EXPECT_EQ(log.entries().size(), 1u);
}

// A picture of 1 + its own direction holds 4 pi of light, and adds up to a direction of 4 pi / 3 along the axis of each
// channel. It stands in a space whose x is the world's y.
TEST_F(BatchRays, GatherDrawsTheLightOfAnEnvironment) {
  const std::string path = pictureOfDirections("tomales_gathered.exr");
  worldFromObject = Motion::still(mat4(vec4(0, 1, 0, 0), vec4(-1, 0, 0, 0), vec4(0, 0, 1, 0), vec4(0, 0, 0, 1)));
  const std::vector<vec3> c = asked(2, [&](sl::Surface& s) {
    Color color, sum;
    Vector direction, redDirection;
    Float solidAngle, hits = 0, length;
    gather(("environment:" + path).c_str(), s.P, Vector(), 0, 4096, rays("environmentspace", "object"),
           {{"environment:color", &color},
            {"environment:solidangle", &solidAngle},
            {"ray:direction", &direction},
            {"ray:length", &length}},
           [&] { hits += 1; },
           [&] {
             sum += color * solidAngle;
             redDirection += xcomp(color) * solidAngle * direction;
           });
    EXPECT_EQ(hits[0], 0);
    EXPECT_EQ(length[0], 1e30f);
    EXPECT_NEAR(redDirection[0].x, 0, 0.05f);
    EXPECT_NEAR(redDirection[0].y, 4 * kPi / 3, 0.05f);
    s.Ci = sum;
  });
  expectColor(c[0], vec3(4 * kPi), 0.1f);
  EXPECT_TRUE(services.asked.empty()) << "nothing is traced";
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchRays, ImportanceIsTheProductOfWeights) {
  ShadeContext context;
  context.importance = 0.25f;
  const std::vector<vec3> c = asked(
      2,
      [](sl::Surface& s) {
        Float importance, shadow;
        std::string type, label;
        EXPECT_TRUE(rayinfo("importance", importance) && rayinfo("shadowdepth", shadow) && rayinfo("type", type) &&
                    rayinfo("label", label));
        EXPECT_FALSE(rayinfo("depth", type)) << "a number is no text";
        EXPECT_EQ(type, "camera");
        trace(s.P, s.I, "weight", 0.5);
        s.Ci = Color(importance, shadow, traceDistance(s.P, s.I, "maxdist", 2));
      },
      context);
  expectColor(c[0], {0.25f, 0, 1e30f});
  EXPECT_EQ(services.asked[0].importance, 0.5f);
  EXPECT_EQ(services.asked[1].maxDistance, 2);
}

TEST_F(BatchRays, PointsKnowTheRayThatCame) {
  ShadeContext context;
  context.kind = RayKind::Diffuse;
  context.diffuseDepth = 2;
  context.specularDepth = 1;
  context.label = "here";
  const std::vector<vec3> c = asked(
      2,
      [](sl::Surface& s) {
        Triple depth;
        EXPECT_TRUE(rayinfo("diffusedepth", depth));
        EXPECT_FALSE(rayinfo("colour", depth));
        EXPECT_TRUE(isindirectray());
        EXPECT_FALSE(isshadowray());
        EXPECT_EQ(raylabel(), "here");
        EXPECT_EQ(raydepth(), 3);
        s.Ci = depth;
      },
      context);
  EXPECT_EQ(c[0].x, 2);
}

TEST_F(BatchRays, DiffuseRaysAreThatWhetherTheyWantHighlightsOrNot) {
  light("distantlight");
  ShadeContext context;
  context.kind = RayKind::Diffuse;
  for (const auto wanted : {HitHighlights::None, HitHighlights::OfSpecular, HitHighlights::All}) {
    context.highlights = wanted;
    const std::vector<vec3> c = asked(
        1,
        [](sl::Surface& s) {
          Triple wants;
          EXPECT_TRUE(isindirectray());
          EXPECT_TRUE(rayinfo("highlights", wants));
          s.Ci = Color(xcomp(wants), xcomp(phong(s.N, -s.I, 1)), xcomp(specular(s.N, -s.I, 8)));
        },
        context);
    const bool all = wanted == HitHighlights::All;
    EXPECT_EQ(c[0].x, all);
    EXPECT_NEAR(c[0].y, all, 1e-5f);
    EXPECT_NEAR(c[0].z, wanted != HitHighlights::None, 1e-5f);
  }
}

/// Notes the widths of rays and answers nothing.
class Widths : public test::BareServices {
 public:
  mutable std::vector<vec2> noted;
  void trace(const ShadePoints&, const uint8_t*, TmConstVec3, TmConstVec3, const RayQuery& query, const ShadeContext&,
             const RayResult& result) const override {
    noted.emplace_back(query.radius[0], query.spread[0]);
    result.distance[0] = kInfinity;
  }
};

// Differentials: rays start as wide as the micropolygon and widen with it and with the cone.
TEST_F(BatchRays, RaysAreAsWideAsWhatTheyLeave) {
  const Widths wide;
  body = [](sl::Surface& s) {
    TmRayOptions cone = tmRayDefaults();
    cone.coneAngle = 0.1f;
    cone.samples = 4;
    s.Ci = trace(s.P, -s.I);
    s.Ci += trace(s.P, -s.I, cone);
  };
  ShadePoints p = points({vec3(0, 0, 5)});
  p.set3(kDpduX, 0, {3, 0, 0});
  p.set3(kDpdvX, 0, {0, 4, 0});
  p.set3(kIx, 0, {0, 0, 5});
  p.channel(kDu)[0] = p.channel(kDv)[0] = 0.01f;
  system().setServices(&wide);
  shade(p);
  ASSERT_EQ(wide.noted.size(), 5u);
  EXPECT_NEAR(wide.noted[0].x, 0.025f, 1e-6f);
  EXPECT_NEAR(wide.noted[0].y, 0.04f / 5, 1e-6f) << "as a mirror spreads what the eye sees";
  EXPECT_NEAR(wide.noted[1].y, 0.04f / 5 + 0.05f, 1e-6f);
}

}  // namespace
}  // namespace tomales
