// Plastic with a ray-traced reflection. In RSL:
//
//   surface shinyplastic(float Ka = 1, Kd = .5, Ks = .5, roughness = .1, Kr = 1, eta = 1.5; color specularcolor = 1) {
//     normal Nf = faceforward(normalize(N), I);
//     vector V = -normalize(I);
//     float kr, kt;
//     fresnel(-V, Nf, 1 / eta, kr, kt);
//     color reflection = trace(P, reflect(-V, Nf));
//     Oi = Os;
//     Ci = Os * (Cs * (Ka * ambient() + Kd * kt * diffuse(Nf)) + specularcolor * Ks * specular(Nf, V, roughness) +
//                Kr * kr * reflection);
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::FloatParam Ka("Ka", 1, "weight of ambient light"), Kd("Kd", 0.5f, "weight of diffuse light"),
    Ks("Ks", 0.5f, "weight of highlights");
rsl::FloatParam roughness("roughness", 0.1f, "width of highlights"), Kr("Kr", 1, "weight of the reflection"),
    eta("eta", 1.5f, "index of refraction");
rsl::ColorParam specularcolor("specularcolor", {1, 1, 1}, "colour of highlights");

struct shinyplastic : Surface {
  void main() {
    Normal Nf = faceforward(normalize(N), I);
    Vector V = -normalize(I);
    Float kr, kt;
    fresnel(-V, Nf, 1 / eta, kr, kt);
    Color reflection = trace(P, reflect(-V, Nf));
    Oi = Os;
    Ci = Os * (Cs * (Ka * ambient() + Kd * kt * diffuse(Nf)) + specularcolor * Ks * specular(Nf, V, roughness) +
               Kr * kr * reflection);
  }
};
const rsl::Shader shader(TM_SURFACE, "shinyplastic", "plastic that mirrors by Fresnel's equations",
                         TM_KEEPS_OPACITY | TM_TRACES, sl::shade<shinyplastic>,
                         {&Ka, &Kd, &Ks, &roughness, &Kr, &eta, &specularcolor});
}  // namespace

TM_SHADER_LIBRARY(shader)
