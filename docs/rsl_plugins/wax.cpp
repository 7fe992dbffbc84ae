// A translucent body, in two frames: what enters is baked from where the light is, what leaves is seen. In RSL:
//
//   surface wax(string cloudname = "", material = "marble"; float baking = 0, unitlength = 1, Ks = .3, roughness = .1)
//   {
//     normal Nf = faceforward(normalize(N), I);
//     Oi = Os;
//     if (baking != 0) {
//       Ci = diffuse(Nf);
//       bake3d(cloudname, "_area,_radiance_t", P, Nf, "_area", area(P), "_radiance_t", Ci);
//     } else
//       Ci = Os * (subsurface(P, Nf, "filename", cloudname, "material", material, "unitlength", unitlength) + Ks *
//       specular(Nf, -normalize(I), roughness));
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::StringParam cloudname("cloudname", "", "point cloud of the light that enters"),
    material("material", "marble", "what the body is made of");
rsl::UniformFloatParam baking("baking", 0, "1: the light that enters is baked"),
    unitlength("unitlength", 1, "millimetres of one unit of the world");
rsl::FloatParam Ks("Ks", 0.3f, "weight of highlights"), roughness("roughness", 0.1f, "width of highlights");

struct wax : Surface {
  void main() {
    Normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    if (uniform(baking) != 0) {
      Ci = diffuse(Nf);
      bake3d(uniform(cloudname), P, Nf, {{"_area", area(P)}, {"_radiance_t", Ci}});
    } else {
      Ci = Os * (subsurface(P, Nf, uniform(cloudname), "material", material, "unitlength", unitlength) +
                 Ks * specular(Nf, -normalize(I), roughness));
    }
  }
};

const rsl::Shader shader(TM_SURFACE, "wax", "a translucent body", TM_KEEPS_OPACITY, shade<wax>,
                         {&cloudname, &material, &baking, &unitlength, &Ks, &roughness});
}  // namespace

TM_SHADER_LIBRARY(shader)
