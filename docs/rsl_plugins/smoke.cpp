// Smoke, marched along the ray from the eye and lit on the way: lights shine into it, what stands in it casts shadows
// through it, and it dims the light that has to cross it. In RSL:
//
//   volume smoke(float density = 1, frequency = 1, steps = 32, octaves = 3, top = 2, lightsteps = 4;
//                color smokecolor = .8) {
//     float smokeat(point Q) {
//       float d = 0, amp = 1, f = frequency, k;
//       for (k = 0; k < octaves; k += 1) { d += amp * (2 * noise(f * Q) - 1);  f *= 2;  amp *= .5; }
//       return density * smoothstep(0, .7, d + .3) * (1 - smoothstep(0, top, ycomp(Q)));
//     }
//     float stepsize = length(I) / steps, clear = 1, i, k;
//     color Cv = 0;
//     for (i = 0; i < steps; i += 1) {
//       point Q = P - ((i + .5) / steps) * I;                       /* from the surface to the eye */
//       point Qw = transform("world", Q);
//       float seen = exp(-smokeat(Qw) * stepsize);
//       color Li = ambient();
//       illuminance(Q) {
//         vector Lw = normalize(vtransform("world", L));
//         float lamp = abs(length(L) - 1) < 1e-5 ? 1e30 : length(L);    /* L of lights at infinity is of unit length */
//         float way = min(lamp, max(0, top - ycomp(Qw)) / max(ycomp(Lw), .001)), depth = 0;
//         for (k = 0; k < lightsteps; k += 1) depth += smokeat(Qw + ((k + .5) / lightsteps) * way * Lw);
//         Li += Cl * exp(-depth * way / max(lightsteps, 1));
//       }
//       Cv = mix(smokecolor * Li, Cv, seen);  clear *= seen;
//     }
//     Ci = Ci * clear + Cv;  Oi = mix(1, Oi, clear);
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::FloatParam density("density", 1, "of the thickest smoke, for each unit of length"),
    frequency("frequency", 1, "lumps for each unit");
rsl::UniformFloatParam steps("steps", 32, "of the march"), octaves("octaves", 3, "layers of noise");
rsl::FloatParam top("top", 2, "no smoke above this height in the world");
rsl::UniformFloatParam lightsteps("lightsteps", 4, "of the march to each light; 0: smoke does not dim it");
rsl::ColorParam smokecolor("smokecolor", {0.8f, 0.8f, 0.8f}, "share of the light that is scattered");

struct smoke : Volume {
  Float smokeat(const Point& Q) {
    Float d = 0, amp = 1, f = frequency;
    for (int k = 0; k < uniform(octaves); ++k) {
      d += amp * (2 * noise(f * Q) - 1);
      f *= 2, amp *= 0.5;
    }
    return density * smoothstep(0, 0.7, d + 0.3) * (1 - smoothstep(0, top, ycomp(Q)));
  }
  void main() {
    const float n = uniform(steps), m = uniform(lightsteps);
    Float stepsize = length(I) / n, clear = 1;
    Color Cv;
    for (int i = 0; i < n; ++i) {
      Point Q = P - ((i + 0.5) / n) * I;
      Point Qw = transform("world", Q);
      Float seen = exp(-smokeat(Qw) * stepsize);
      Color Li = ambient();
      illuminance(Q, [&] {
        Vector Lw = normalize(vtransform("world", L));
        Float lamp = length(L);
        If(abs(lamp - 1) < 1e-5, [&] { lamp = 1e30; });
        Float way = min(lamp, max(0, top - ycomp(Qw)) / max(ycomp(Lw), 0.001)), depth;
        for (int k = 0; k < m; ++k) depth += smokeat(Qw + ((k + 0.5) / m) * way * Lw);
        Li += Cl * exp(-depth * way / max(m, 1));
      });
      Cv = mix(smokecolor * Li, Cv, seen);
      clear *= seen;
    }
    Ci = Ci * clear + Cv;
    Oi = mix(Color(1), Oi, clear);
  }
};
const rsl::Shader shader(TM_VOLUME, "smoke", "lumps of smoke near the ground, lit by the lights", 0, sl::shade<smoke>,
                         {&density, &frequency, &steps, &octaves, &top, &lightsteps, &smokecolor});
}  // namespace

TM_SHADER_LIBRARY(shader)
