// Lights, imagers and globals of shaders in RSL's manner (reyes/sl.h).
#include "reyes/base/rng.h"
#include "reyes/sl.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

using namespace sl;

constexpr double kCone = 0.6;
rsl::FloatParam sunSamples("samples", 256, "", TM_ROLE_SAMPLES), skySamples("samples", 256, "", TM_ROLE_SAMPLES),
    intensity("intensity", 4, "");
rsl::StringParam map("map", "", "", TM_ROLE_SKY_MAP);

struct hazysun : sl::Light {
  void main() {
    solar(Vector(0, 0, 1), kCone, [&] { Cl = Color(1.0 / grid()->samples); });
  }
};
/// Brighter towards the eye.
struct gradedsky : sl::Light {
  void main() {
    solar([&] { Cl = Color(1 + zcomp(normalize(L))) * (zcomp(P) / 5) * length(N); });  // of the point being lit: z is 5
    L = Vector(1, 0, 0);                                                               // which is the renderer's
  }
};
/// As the arealight that comes with the renderer.
struct panel : sl::Light {
  void main() {
    illuminate(P, N, rsl::kPi / 2, [&] { Cl = Float(intensity) * Color(1.0); });
  }
};
/// An area light that says of its own points where they are.
struct placed : sl::Light {
  void main() { Cl = Color(length(P - Ps), length(L), dot(normalize(L), N)); }
};
struct dimmer : sl::Imager {
  void main() {
    Ci = Ci * xcomp(P);
    alpha = 0.5 * alpha;
    Oi = Color(alpha);
  }
};
struct inquiring : sl::Surface {
  void main() {
    Ci = Color(time, dtime, xcomp(dPdtime));
    Oi = Color(xcomp(E), ycomp(E), ncomps);
  }
};
const rsl::Shader hazysunShader(TM_LIGHT, "hazysun", "", TM_LIGHT_SOLAR | TM_LIGHT_SAMPLED, sl::shade<hazysun>,
                                {&sunSamples});
const rsl::Shader gradedskyShader(TM_LIGHT, "gradedsky", "", TM_LIGHT_SOLAR | TM_LIGHT_SKY, sl::shade<gradedsky>,
                                  {&map, &skySamples});
const rsl::Shader panelShader(TM_LIGHT, "panel", "", TM_LIGHT_AREA, sl::shade<panel>, {&intensity});
const rsl::Shader placedShader(TM_LIGHT, "placed", "", TM_LIGHT_AREA, sl::shade<placed>, {});
const rsl::Shader dimmerShader(TM_IMAGER, "dimmer", "", 0, sl::shade<dimmer>, {});
const rsl::Shader inquiringShader(TM_SURFACE, "inquiring", "", 0, sl::shade<inquiring>, {});

class SlKinds : public Stage {
 protected:
  SlKinds() {
    static const TmShader* const shaders[] = {hazysunShader, gradedskyShader, panelShader,
                                              placedShader,  dimmerShader,    inquiringShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    services.emitter = [](float a, float b, vec3& P, vec3& N, float& area) {
      P = {-1 + 2 * a, -0.5f + b, 3};
      N = {0, 0, 1};
      area = 2;
    };
  }
};

// The mean cosine of a cone around the normal is (1 + cos) / 2.
TEST_F(SlKinds, ASunOfAConeShinesEvenlyOverIt) {
  surface("matte");
  light("hazysun");
  EXPECT_NEAR(shadeOne().x, (1 + std::cos(kCone)) / 2, 1e-3f);
}

TEST_F(SlKinds, LightsThatAreSampledMayBeAskedAlone) {
  surface("matte");
  light("hazysun");
  EXPECT_EQ(system().light(0).kind(), LightKind::Distant);
  LightProbe probe;
  for (uint32_t i = 0; i < 1024; ++i) {
    probe.P.emplace_back(0, 0, 5);
    probe.N.emplace_back(0, 0, -1);
    probe.xi.push_back(sobol2(i, 3U));
  }
  system().probe(0, probe);
  float mean = 0;
  for (const vec3& L : probe.L) mean -= normalizeOr(L, vec3(0)).z / 1024;
  EXPECT_NEAR(mean, (1 + std::cos(kCone)) / 2, 1e-3f);
  LightProbe middle{{vec3(0, 0, 5)}, {vec3(0, 0, -1)}, {}, {}, {}, {}, {}};
  system().probe(0, middle);
  EXPECT_GT(middle.Cl[0].x, 0.5f);
}

// Radiance 1 + cosine is E/pi 1 + 2/3.
TEST_F(SlKinds, SkiesOfShadersInTheMannerOfRslShineFromTheDirectionsThatAreAsked) {
  surface("matte");
  light("gradedsky");
  EXPECT_NEAR(shadeOne().x, 1 + 2.0f / 3, 2e-3f);
}

TEST_F(SlKinds, AreaLightsKnowThePointOnTheLight) {
  surface("matte");
  light("panel", {}, true);
  const vec3 own = shadeOne();
  attributes.lights.clear();
  scene.lights.clear();
  scene.objects.clear();
  scene.groups.clear();
  shading.reset();
  light("arealight", {number("intensity", 4)}, true);
  expectColor(own, shadeOne());
  EXPECT_GT(own.x, 0.1f);
  attributes.lights.clear();
  scene.lights.clear();
  scene.objects.clear();
  scene.groups.clear();
  shading.reset();
  light("placed", {}, true);
  const vec3 place = shadeOne();
  EXPECT_NEAR(place.x, place.y, 1e-5f) << "from P to Ps, with no illuminate()";
  EXPECT_GT(place.z, 0);
}

TEST_F(SlKinds, ImagersReadAndWritePixels) {
  scene.options.imager = call("dimmer", {});
  ShadedPixels pixels;
  pixels.x = 2.5f;
  pixels.y = 1.5f;
  pixels.count = 2;
  pixels.colors.resize(2);
  pixels.colors.set(0, vec3(1), vec3(1));
  pixels.colors.set(1, vec3(2), vec3(1));
  pixels.alpha.assign(pixels.colors.Ci[0].size(), 1.0f);
  system().image(pixels);
  expectColor(pixels.colors.color(0), vec3(2.5f));
  expectColor(pixels.colors.color(1), vec3(7));
  expectColor(pixels.colors.opacity(1), vec3(0.5f));
  EXPECT_EQ(pixels.alpha[1], 0.5f);
}

TEST_F(SlKinds, SurfacesKnowTheEyeTheTimeAndTheirVelocity) {
  surface("inquiring");
  scene.options.shutterOpen = 1;
  scene.options.shutterClose = 3;
  ShadePoints p = points({vec3(0, 0, 5)});
  p.set3(kDriftX, 0, vec3(4, 0, 0));
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {1, 2, 2});
  expectColor(out.opacity(0), {0, 0, 3});
}

}  // namespace
}  // namespace tomales
