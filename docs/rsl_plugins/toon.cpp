// Flat tones with an outline of even width on the screen. In RSL:
//
//   surface toon(float tones = 3, outline = 2; color inkcolor = 0) {
//     normal Nf = faceforward(normalize(N), I);
//     float light = 0;
//     illuminance (P, Nf, PI / 2) { light += .3333 * (comp(Cl, 0) + comp(Cl, 1) + comp(Cl, 2)) * (normalize(L) . Nf); }
//     float tone = floor(light * tones + .5) / tones;
//     float facing = -normalize(I) . Nf;
//     float pixel = abs(Du(facing) * du) + abs(Dv(facing) * dv);             /* change over a micropolygon */
//     float ink = 1 - filterstep(outline * pixel, facing, pixel);
//     Oi = Os;
//     Ci = Os * mix(Cs * (ambient() + tone), inkcolor, ink);
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::FloatParam tones("tones", 3, "steps from dark to bright"),
    outline("outline", 2, "width of the line in micropolygons");
rsl::ColorParam inkcolor("inkcolor", {0, 0, 0}, "colour of the line");

struct toon : Surface {
  void main() {
    Normal Nf = faceforward(normalize(N), I);
    Float light = 0;
    illuminance(P, Nf, rsl::kPi / 2,
                [&] { light += 0.3333 * (comp(Cl, 0) + comp(Cl, 1) + comp(Cl, 2)) * dot(normalize(L), Nf); });
    Float tone = floor(light * tones + 0.5) / tones;
    Float facing = dot(-normalize(I), Nf);
    Float pixel = abs(Du(facing) * du) + abs(Dv(facing) * dv);
    Float ink = 1 - filterstep(outline * pixel, facing, pixel);
    Oi = Os;
    Ci = Os * mix(Cs * (ambient() + tone), inkcolor, ink);
  }
};
const rsl::Shader shader(TM_SURFACE, "toon", "flat tones and an outline", TM_KEEPS_OPACITY | TM_NEIGHBOURS,
                         sl::shade<toon>, {&tones, &outline, &inkcolor});
}  // namespace

TM_SHADER_LIBRARY(shader)
