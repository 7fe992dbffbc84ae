// Smoke, marched along the ray from the eye. In RSL:
//
//   volume smoke(float density = 1, frequency = 1, steps = 32, octaves = 3, top = 2; color smokecolor = .8) {
//     point Pw = transform("world", P);  vector Iw = vtransform("world", I);
//     float stepsize = length(I) / steps;
//     color Cv = 0;  float clear = 1;
//     for (i = 0; i < steps; i += 1) {
//       point Q = Pw - ((i + .5) / steps) * Iw;                     /* from the surface to the eye */
//       float d = 0, amp = 1, f = frequency;
//       for (k = 0; k < octaves; k += 1) { d += amp * (2 * noise(f * Q) - 1);  f *= 2;  amp *= .5; }
//       d = density * smoothstep(0, .7, d + .3) * (1 - smoothstep(0, top, ycomp(Q)));
//       float seen = exp(-d * stepsize);
//       Cv = mix(smokecolor, Cv, seen);  clear *= seen;
//     }
//     Ci = Ci * clear + Cv;  Oi = mix(1, Oi, clear);
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::FloatParam density("density", 1, "of the thickest smoke, for each unit of length"), frequency("frequency", 1, "lumps for each unit");
rsl::UniformFloatParam steps("steps", 32, "of the march"), octaves("octaves", 3, "layers of noise");
rsl::FloatParam top("top", 2, "no smoke above this height in the world");
rsl::ColorParam smokecolor("smokecolor", {0.8f, 0.8f, 0.8f}, "colour");

struct smoke : Volume {
  void main() {
    Point Pw = transform("world", P);
    Vector Iw = vtransform("world", I);
    const float n = uniform(steps);
    Float stepsize = length(I) / n;
    Color Cv;
    Float clear = 1;
    for (int i = 0; i < n; ++i) {
      Point Q = Pw - ((i + 0.5) / n) * Iw;
      Float d = 0, amp = 1, f = frequency;
      for (int k = 0; k < uniform(octaves); ++k) {
        d += amp * (2 * noise(f * Q) - 1);
        f *= 2, amp *= 0.5;
      }
      d = density * smoothstep(0, 0.7, d + 0.3) * (1 - smoothstep(0, top, ycomp(Q)));
      Float seen = exp(-d * stepsize);
      Cv = mix(smokecolor, Cv, seen);
      clear *= seen;
    }
    Ci = Ci * clear + Cv;
    Oi = mix(Color(1), Oi, clear);
  }
};
const rsl::Shader shader(TM_VOLUME, "smoke", "lumps of smoke near the ground", 0, sl::shade<smoke>,
                         {&density, &frequency, &steps, &octaves, &top, &smokecolor});
}  // namespace

TM_SHADER_LIBRARY(shader)
