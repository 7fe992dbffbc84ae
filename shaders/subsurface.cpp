// A body under whose surface light spreads, by the diffusion of H. W. Jensen, S. Marschner, M. Levoy and P. Hanrahan,
// "A Practical Model for Subsurface Light Transport", SIGGRAPH 2001. One frame bakes the light that enters, seen from
// where it comes from; the frames after it show what leaves.
#include "reyes/sl.h"

using namespace sl;

namespace {
rsl::StringParam cloudname("cloudname", "", "point cloud of the light that enters");
rsl::UniformFloatParam baking("baking", 0, "1: this frame makes that cloud");
rsl::StringParam material("material", "marble", "a measured one, as `skin1`, or none for albedo and meanfreepath");
rsl::ColorParam albedo("albedo", {0.8f, 0.8f, 0.8f}, "diffuse albedo, of material \"\"");
rsl::ColorParam meanfreepath("meanfreepath", {1, 1, 1}, "diffuse mean free path in millimetres, of material \"\"");
rsl::UniformFloatParam unitlength("unitlength", 1, "millimetres of one unit of the world");
rsl::UniformFloatParam eta("eta", 1.3f, "index of refraction of the inside");
rsl::FloatParam Ks("Ks", 0.3f, "weight of highlights"), roughness("roughness", 0.1f, "width of highlights");

struct Body : Surface {
  /// One colour for the whole body, that of the first point.
  static rsl::Color ofBody(const rsl::ColorParam& p) {
    for (const int i : rsl::Batch(grid())) return p(grid(), i);
    return {};
  }
  Color leaving(const Normal& Nf) {
    const char* const file = uniform(cloudname);
    if (material != "") return subsurface(P, Nf, file, "material", material, "ior", eta, "unitlength", unitlength);
    return subsurface(P, Nf, file, "albedo", ofBody(albedo), "diffusemeanfreepath", ofBody(meanfreepath), "ior", eta,
                      "unitlength", unitlength);
  }
  void main() {
    const Normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    if (uniform(baking) != 0) {
      Ci = diffuse(Nf);
      bake3d(uniform(cloudname), P, Nf, {{"_area", area(P)}, {"_radiance_t", Ci}});
    } else {
      Ci = Os * (Cs * leaving(Nf) + Ks * specular(Nf, -normalize(I), roughness));
    }
  }
};
}  // namespace

extern const rsl::Shader subsurfaceShader;
const rsl::Shader subsurfaceShader(TM_SURFACE, "subsurface", "a body under whose surface light spreads, in two frames",
                                   TM_KEEPS_OPACITY, shade<Body>,
                                   {&cloudname, &baking, &material, &albedo, &meanfreepath, &unitlength, &eta, &Ks,
                                    &roughness});
