// Area lights: their samples, their shadows, their glow and their size.
#include "reyes/area_lights.h"

#include <utility>

#include "reyes/shader.h"
#include "reyes/shader_registry.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

// The irradiance of a polygon of unit radiance over pi (Lambert 1760): sum of edge angles times edge normals.
double lambert(const std::vector<glm::dvec3>& polygon, const glm::dvec3& P, const glm::dvec3& N) {
  double sum = 0;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec3 a = glm::normalize(polygon[k] - P), b = glm::normalize(polygon[(k + 1) % polygon.size()] - P);
    sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), N);
  }
  return std::abs(sum) / (2 * 3.14159265358979323846);
}

class AreaLight : public Stage {
 protected:
  // A rectangle in z = 3 that faces +z, as the floor at z = 5 faces -z.
  void rectangle(const vec3& normal) {
    services.emitter = [normal](float a, float b, vec3& P, vec3& N, float& area) {
      P = {-1 + 2 * a, -0.5f + b, 3};
      N = normal;
      area = 2;
    };
  }
};

TEST_F(AreaLight, IrradianceOfARectangleIsTheClosedFormAtNinePoints) {
  surface("matte");
  light("arealight", {number("intensity", 4)}, true);
  rectangle({0, 0, 1});
  std::vector<vec3> P;
  for (int i = 0; i < 9; ++i) P.push_back({static_cast<float>(i % 3), static_cast<float>(i / 3) - 1, 5});
  ShadeContext fine;
  fine.lightSamples = 1024;
  const ShadedPoints out = shade(points(P), fine);
  for (int i = 0; i < 9; ++i) {
    const double E =
        4 * lambert({{-1, -.5, 3}, {1, -.5, 3}, {1, .5, 3}, {-1, .5, 3}}, P[static_cast<size_t>(i)], {0, 0, -1});
    EXPECT_NEAR(out.color(i).x, E, 0.01 * E) << "point " << i;
  }
}

// Two loops that ask for several times the samples: their number and sum, and the number of the second loop.
void countSamples(const TmGrid* g) {
  for (const int64_t times : {3, 5}) {
    TmIlluminance sample = tmIlluminanceDefaults();
    for (sample.times = times; g->call->illuminance(g->host, g, &sample);)
      for (const int i : rsl::Batch(g)) {
        const rsl::Vec3 first{1, rsl::get(sample.Cl, i).x, 0}, second{0, 0, 1};
        rsl::set(g->Ci, i, rsl::get(g->Ci, i) + (times == 3 ? first : second));
      }
  }
}

TEST_F(AreaLight, HasSoManyTimesItsSamplesAsTheFirstLoopOfASurfaceAsks) {
  static const rsl::Shader counting(TM_SURFACE, "counting", "", 0, countSamples, {});
  static const TmShader* const shaders[] = {counting};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  light("arealight", {number("samples", 4)}, true);
  light("distantlight", {number("intensity", 0)});
  rectangle({0, 0, 1});
  surface("counting");
  const vec3 counted = shadeOne();
  EXPECT_EQ(counted.x, 3 * 4 + 1);
  EXPECT_EQ(counted.z, counted.x);
  ShadeContext fine;
  fine.lightSamples = 1024;
  const float sum = shade(points({vec3(0, 0, 5)}), fine).color(0).y;
  EXPECT_NEAR(counted.y, sum, 0.1f * sum);
}

// The point mirrors nothing of the lamp, so only the lamp's own samples send rays.
TEST_F(AreaLight, HasFourTimesItsSamplesWhereTheEyeSeesNothingButMetal) {
  light("arealight", {number("samples", 4)}, true);
  rectangle({0, 0, 1});
  const auto raysOn = [&](float metallic, const ShadeContext& context = {}) {
    shading.reset();
    scene.objects.clear();
    surface("disney", {number("metallic", metallic), number("roughness", 0.1f)});
    services.shadowRays = 0;
    shade(points({vec3(3, 0, 5)}), context);
    return services.shadowRays;
  };
  EXPECT_EQ(raysOn(1), 16);
  EXPECT_EQ(raysOn(0.5f), 4);
  ShadeContext mirrored;
  mirrored.kind = RayKind::Specular;
  mirrored.specularDepth = 1;
  EXPECT_EQ(raysOn(1, mirrored), 4);
}

TEST_F(AreaLight, StopsTracingShadowsWhereTheirMeanIsKnownWellEnough) {
  surface("matte");
  light("arealight", {number("samples", 64), number("shadowvariance", 0.002f)}, true);
  rectangle({0, 0, 1});
  const auto visible = [](const vec3& P, const vec3& toward) { return (P + toward).x > 0.3f ? 0.0f : 1.0f; };
  const ShadePoints clear = points({vec3(0, 0, 5)});
  const float open = shade(clear).color(0).x;
  const int inTheOpen = std::exchange(services.shadowRays, 0);
  services.visible = visible;
  const float penumbra = shade(clear).color(0).x;
  EXPECT_LT(inTheOpen, 24);  // 0.5 / (n + 1) (1 - 0.5 / (n + 1)) / n < 0.002 at n = 16
  EXPECT_GT(services.shadowRays, 2 * inTheOpen);
  ShadeContext fine;
  fine.lightSamples = 4096;
  EXPECT_NEAR(penumbra / open, shade(clear, fine).color(0).x / open, 3 * std::sqrt(0.002f));
}

TEST_F(AreaLight, EmitsFromTheSideOfItsNormalOnly) {
  surface("matte");
  light("arealight", {}, true);
  rectangle({0, 0, -1});
  expectColor(shadeOne(), vec3(0.0f), 0);
}

TEST_F(AreaLight, ShadowRaysGoToTheSampleAndOnlyFromPointsOnItsSide) {
  surface("plastic");
  light("arealight", {number("samples", 8)}, true);
  rectangle({0, 0, 1});
  services.visible = [](const vec3& P, const vec3& toward) {
    EXPECT_NEAR((P + toward).z, 3, 1e-5f);
    return 0.0f;
  };
  expectColor(shadeOne(), vec3(0.0f), 0);
  EXPECT_EQ(services.shadowRays, 8);  // diffuse() and specular() share them
  shade(points({vec3(0, 0, 5)}, vec3(0, 1, 0)));
  EXPECT_LT(services.shadowRays, 16);  // this point sees half of the rectangle
}

TEST_F(AreaLight, GlowsForTheCameraUnlessInvisible) {
  light("arealight", {number("intensity", 3), color("lightcolor", {1, 2, 4})}, true);
  light("arealight", {number("visible", 0)}, true);
  attributes.areaLight = 0;
  EXPECT_EQ(emissionOf(system(), points({vec3(0, 0, 5)})), std::vector<vec3>{vec3(3, 6, 12)});
  EXPECT_TRUE(system().needsRays());
  shading.reset();
  scene.objects.clear();
  attributes.areaLight = 1;
  EXPECT_TRUE(emissionOf(system(), points({vec3(0, 0, 5)})).empty());
}

TEST_F(AreaLight, SamplesDoNotDependOnTheCompanyOfAPoint) {
  surface("matte");
  light("arealight", {}, true);
  rectangle({0, 0, 1});
  std::vector<vec3> many(600, vec3(0.3f, 0.4f, 5));
  const ShadedPoints together = shade(points(many));
  ShadePoints alone(0, 0);
  const ShadePoints all = points(many);
  alone.add(all.key(517));
  for (int c = 0; c < all.channelCount(); ++c) alone.channel(c)[0] = all.channel(c)[517];
  EXPECT_EQ(shade(alone).color(0), together.color(517));
  EXPECT_NE(together.color(517), together.color(516));
  ShadeContext reseeded;
  reseeded.seed = 1;
  EXPECT_NE(shade(alone, reseeded).color(0), together.color(517));
}

/// A rectangle of 2 x 3 in its plane.
class Rectangle final : public Prim {
 public:
  Rectangle() : Prim({}) {}
  uint32_t patchCount() const override { return 2; }
  PatchInfo info(uint32_t) const override { return {}; }
  Bound3 bound(uint32_t, const UvRect&) const override { return {vec3(0), vec3(2, 3, 0)}; }
  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    for (int i = 0; i < n; ++i) {
      EXPECT_TRUE(u[i] >= 0 && u[i] <= 1 && v[i] >= 0 && v[i] <= 1) << "a patch has nothing beyond its edges";
      out.px[i] = u[i] + static_cast<float>(patch);
      out.py[i] = 3 * v[i];
      out.pz[i] = 0;
    }
  }
  void interpolate(uint32_t, int, int, const float*, const float*, float*, int) const override {}
  Kept kept(uint32_t patch, const UvRect& r) const override {
    if (!isTrimmed) return Kept::All;
    if (patch != 0 || r.u0 >= r.v1) return Kept::None;
    return r.u1 <= r.v0 ? Kept::All : Kept::Part;
  }
  bool keeps(uint32_t patch, float u, float v) const override { return !isTrimmed || (patch == 0 && u < v); }

  bool isTrimmed = false;
};

TEST_F(AreaLight, BmrtMeasuresTheGeometryOfAreaLights) {
  for (const bool bmrt : {true, false}) {
    scene.objects.clear();
    scene.lights.clear();
    if (bmrt)
      scene.options.user["shade:arealight"] = text("arealight", "bmrt");
    else
      scene.options.user.clear();
    light("arealight", {}, true);
    auto lamp = std::make_shared<Attributes>();
    lamp->areaLight = 0;
    Object o;
    o.shapes = {std::make_shared<Rectangle>()};
    mat4 twice(2.0f);
    twice[3][3] = 1;
    o.worldFromObject = Motion::still(twice);
    o.attributes = lamp;
    scene.objects.push_back(o);
    scene.freeze();
    measureAreaLights(scene, registry, log);
    const ParamList& params = scene.lights[0]->shader.params;
    ASSERT_EQ(params.size(), bmrt ? 1u : 0u);
    if (!bmrt) continue;
    EXPECT_NEAR(params[0].number(0), 2 * 3 * 4, 1e-3f);
    auto trimmed = std::make_shared<Rectangle>();
    trimmed->isTrimmed = true;
    scene.objects[0].shapes = {trimmed};
    scene.lights[0]->shader.params.clear();
    measureAreaLights(scene, registry, log);
    EXPECT_NEAR(scene.lights[0]->shader.params.at(0).number(0), 0.25f * 2 * 3 * 4, 0.1f) << "of what trim curves leave";
  }
}

}  // namespace
}  // namespace tomales
