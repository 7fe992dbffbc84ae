// Stone: displaced in the large, bumped in the small. In RSL:
//
//   displacement stone(float Km = .1, frequency = 2) {
//     point Q = frequency * transform("shader", P);
//     float h = 0, amp = 1, k;
//     for (k = 0; k < 4; k += 1) { h += amp * abs(2 * noise(Q) - 1);  Q *= 2;  amp *= .5; }
//     P -= Km * h * normalize(N);
//     N = calculatenormal(P);
//   }
//
//   surface stonesurface(float Ka = 1, Kd = .8, Kb = .01, frequency = 40; color dark = (.25, .22, .2)) {
//     point Q = transform("shader", P);
//     float grain = noise(frequency * Q);
//     normal Nb = normalize(calculatenormal(P + Kb * grain * normalize(N)));     /* P stays: bumps alone */
//     normal Nf = faceforward(Nb, I);
//     Oi = Os;
//     Ci = Os * mix(dark, Cs, smoothstep(.2, .8, grain)) * (Ka * ambient() + Kd * diffuse(Nf));
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::FloatParam Km("Km", 0.1f, "depth of the hollows"), lumps("frequency", 2, "lumps for each unit");

struct stone : Displacement {
  void main() {
    Point Q = lumps * transform("shader", P);
    Float h = 0, amp = 1;
    for (int k = 0; k < 4; ++k) {
      h += amp * abs(2 * noise(Q) - 1);
      Q *= 2, amp *= 0.5;
    }
    P -= Km * h * normalize(N);
    N = calculatenormal(P);
  }
};
const rsl::Shader displacement(TM_DISPLACEMENT, "stone", "ridged hollows; bound: 2 Km", 0, sl::shade<stone>,
                               {&Km, &lumps});

rsl::FloatParam Ka("Ka", 1, "weight of ambient light"), Kd("Kd", 0.8f, "weight of diffuse light"),
    Kb("Kb", 0.01f, "height of the grains");
rsl::FloatParam grains("frequency", 40, "grains for each unit");
rsl::ColorParam dark("dark", {0.25f, 0.22f, 0.2f}, "colour between grains");

struct stonesurface : Surface {
  void main() {
    Point Q = transform("shader", P);
    Float grain = noise(grains * Q);
    Normal Nb = normalize(calculatenormal(P + Kb * grain * normalize(N)));
    Normal Nf = faceforward(Nb, I);
    Oi = Os;
    Ci = Os * mix(dark, Cs, smoothstep(0.2, 0.8, grain)) * (Ka * ambient() + Kd * diffuse(Nf));
  }
};
const rsl::Shader surface(TM_SURFACE, "stonesurface", "grains that are bumps", TM_KEEPS_OPACITY | TM_NEIGHBOURS,
                          sl::shade<stonesurface>, {&Ka, &Kd, &Kb, &grains, &dark});
}  // namespace

TM_SHADER_LIBRARY(displacement, surface)
