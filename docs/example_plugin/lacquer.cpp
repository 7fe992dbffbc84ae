// Rough lacquer over a turbulent paint: the lobe of reyes/shader/ggx.h under all lights, and the patterns of
// reyes/shader/sl_patterns.h, which fade where micropolygons are too coarse for them.
#include <reyes/shader/ggx.h>
#include <reyes/shader/sl_patterns.h>

namespace {

rsl::FloatParam roughness("roughness", 0.3f, "of the lacquer"), grain("grain", 8, "waves of the paint in a unit");

struct lacquer : sl::Surface {
  void main() {
    const sl::Normal Nf = faceforward(normalize(N), I);
    const sl::Vector V = normalize(-I);
    const sl::Point p = sl::Point(transform("shader", P)) * sl::Float(grain);
    const sl::Color paint = Cs * clamp(sl::turbulence(p, sl::filterwidthp(p)), 0, 1);
    sl::Color shine;
    illuminance(P, Nf, rsl::kPi / 2, [&] {
      const sl::Vector Ln = normalize(L), H = normalize(Ln + V);
      const sl::Float NL = dot(Nf, Ln), NV = dot(Nf, V), NH = dot(Nf, H);
      // Light is E/pi, so that a BRDF is multiplied by pi.
      const sl::Float f = sl::Float::of([&](int i) {
        const float width = roughness(sl::grid(), i);
        return rsl::kPi *
               rsl::Ggx(width * width + 1e-3f).reflection(rsl::clamp(NL[i], 0, 1), rsl::clamp(NV[i], 0, 1), NH[i]);
      });
      shine += Cl * NL * f * 0.04f;
    });
    Oi = Os;
    Ci = Os * (paint * (sl::ambient() + diffuse(Nf)) + shine);
  }
};
const rsl::Shader shader(TM_SURFACE, "lacquer", "rough lacquer over turbulent paint",
                         TM_KEEPS_OPACITY | TM_TRACES_HIGHLIGHTS | TM_DERIVATIVES | TM_NEIGHBOURS, sl::shade<lacquer>,
                         {&roughness, &grain});

}  // namespace
TM_SHADER_LIBRARY(shader)
