// Highlights of shaders in RSL's manner, and lights that are such shaders.
#include "tests/unit/shade/obedient.h"

namespace tomales {
namespace {

using namespace sl;

struct coned : sl::Light {
  void main() {
    illuminate(Point(0, 0, 0), Vector(0, 0, 1), 0.3, [&] { Cl = Color(2 / dot(L, L)); });
  }
};
struct sunny : sl::Light {
  void main() {
    solar(Vector(0, 3, 4), [&] { Cl = Color(1, 0.5, 0.25); });
  }
};
const rsl::Shader conedShader(TM_LIGHT, "coned", "", 0, sl::shade<coned>, {});
const rsl::Shader sunnyShader(TM_LIGHT, "sunny", "", TM_LIGHT_SOLAR, sl::shade<sunny>, {});

class BatchLights : public BatchServices {
 protected:
  BatchLights() {
    static const TmShader* const shaders[] = {conedShader, sunnyShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
};

TEST_F(BatchLights, PhongAndTheLobeOfSpecularAreTheirFormulas) {
  light("distantlight", {point("to", {0, 3, 4})});  // from the light: (0, 0.6, 0.8)
  const std::vector<vec3> c = asked(4, [](sl::Surface& s) {
    const Normal N = s.N;
    s.Ci = Color(xcomp(phong(N, Vector(0, 0, -2), 5)), specularbrdf(Vector(0, -3, -4), N, -s.I, 0.5),
                 xcomp(specular(N, -s.I, 0.5)));
  });
  const double H = (0.8 + 1) / std::hypot(0.6, 1.8);
  expectColor(c[0],
              vec3(static_cast<float>(std::pow(0.8, 5)), static_cast<float>(std::pow(H, 16)),
                   static_cast<float>(std::pow(H, 16))),
              1e-5f);
}

TEST_F(BatchLights, TheLobeHasTheExponentThatTheSceneChoosesAsSpecularHas) {
  scene.options.user["shade:specular"] = text("shade:specular", "rispec");
  light("distantlight", {point("to", {0, 3, 4})});
  const std::vector<vec3> c = asked(4, [](sl::Surface& s) {
    s.Ci = Color(specularbrdf(Vector(0, -3, -4), s.N, -s.I, 0.5), xcomp(specular(s.N, -s.I, 0.5)), 0);
  });
  const auto highlight = static_cast<float>(std::pow((0.8 + 1) / std::hypot(0.6, 1.8), 2));
  expectColor(c[0], {highlight, highlight, 0}, 1e-5f);
}

TEST_F(BatchLights, LightsInRslsMannerShineIntoTheirConeAndFromTheirDirection) {
  surface("matte");
  light("coned");
  light("sunny");
  const ShadedPoints out = shade(points({vec3(0, 0, 4), vec3(3, 0, 4)}));
  const vec3 sun = 0.8f * vec3(1, 0.5f, 0.25f);
  expectColor(out.color(0), vec3(2 / 16.0f) + sun);
  expectColor(out.color(1), sun);
}

}  // namespace
}  // namespace tomales
