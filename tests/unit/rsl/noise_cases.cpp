// Noise (RISpec 3.2 section 15.1) of all dimensions and results, and what is known of its values.
#include <cmath>

#include "reyes/shader/noise.h"
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
namespace {
Vec3 noiseAt(float i) { return {i * 0.37f, i * 0.21f, 0.5f}; }
#define AT "point q = point (s * 0.37, s * 0.21, 0.5); "
constexpr float kNear = 2e-5f;
}  // namespace

Cases noiseCases() {
  static const Case kCases[] = {
      {"noise of a number",
       "x = noise(s * 0.37);",
       [](float i) { return rsl::noise(i * 0.37f); },
       {.tolerance = kNear}},
      {"noise of two numbers",
       "x = noise(s * 0.37, s * 0.21);",
       [](float i) { return rsl::noise(i * 0.37f, i * 0.21f); },
       {.tolerance = kNear}},
      {"noise of a point", AT "x = noise(q);", [](float i) { return rsl::noise(noiseAt(i)); }, {.tolerance = kNear}},
      {"noise of a point and a number",
       AT "x = noise(q, s * 0.1);",
       [](float i) { return rsl::noise(noiseAt(i), i * 0.1f); },
       {.tolerance = kNear}},
      {"a color's noise of a number",
       "c = noise(s * 0.37);",
       [](float i) { return rsl::noise3(i * 0.37f); },
       {.tolerance = kNear}},
      {"a color's noise of two numbers",
       "c = noise(s * 0.37, s * 0.21);",
       [](float i) { return rsl::noise3(i * 0.37f, i * 0.21f); },
       {.tolerance = kNear}},
      {"a color's noise of a point",
       AT "c = noise(q);",
       [](float i) { return rsl::noise3(noiseAt(i)); },
       {.tolerance = kNear}},
      {"a color's noise of a point and a number",
       AT "c = noise(q, s * 0.1);",
       [](float i) { return rsl::noise3(noiseAt(i), i * 0.1f); },
       {.tolerance = kNear}},
      {"a vector's noise", AT "w = noise(q);", [](float i) { return rsl::noise3(noiseAt(i)); }, {.tolerance = kNear}},
      {"a point's noise",
       AT "point a = noise(q); w = vector a;",
       [](float i) { return rsl::noise3(noiseAt(i)); },
       {.tolerance = kNear}},
      {"a vector cast of noise",
       AT "w = vector noise(q);",
       [](float i) { return rsl::noise3(noiseAt(i)); },
       {.tolerance = kNear}},
      {"noise of a vector",
       AT "x = noise(vector q);",
       [](float i) { return rsl::noise(noiseAt(i)); },
       {.tolerance = kNear}},
      {"noise is in [0, 1]", AT "float a = noise(q * 3.7); if (a >= 0 && a <= 1) x = 1;", 1},
      {"noise has a half for its mean",
       "float k, a = 0; for (k = 0; k < 400; k += 1) a += noise(point (k * 0.731, k * 0.297, s * 0.13)); x = a / 400;",
       0.5f,
       {.tolerance = 0.05f}},
      {"noise does not repeat", "if (noise(point (s + 0.3, 0.4, 0.5)) != noise(point (s + 1.3, 0.4, 0.5))) x = 1;", 1},
      {"noise is continuous", AT "if (abs(noise(q) - noise(q + vector (0.001, 0, 0))) < 0.01) x = 1;", 1},
      {"pnoise of a number",
       "x = pnoise(s * 0.37, 4);",
       [](float i) { return rsl::pnoise(i * 0.37f, 4); },
       {.tolerance = kNear}},
      {"pnoise repeats", "x = pnoise(s * 0.25 + 0.3, 4) - pnoise(s * 0.25 + 4.3, 4);", 0, {.tolerance = 2e-4f}},
      {"pnoise of two numbers",
       "x = pnoise(s * 0.37, s * 0.21, 4, 3);",
       [](float i) { return rsl::pnoise(i * 0.37f, i * 0.21f, 4, 3); },
       {.tolerance = kNear}},
      {"pnoise of a point",
       AT "x = pnoise(q, point (4, 3, 2));",
       [](float i) {
         return rsl::pnoise(noiseAt(i), Vec3{4, 3, 2});
       },
       {.tolerance = kNear}},
      {"pnoise of a point and a number",
       AT "x = pnoise(q, s * 0.1, point (4, 3, 2), 5);",
       [](float i) {
         return rsl::pnoise(noiseAt(i), i * 0.1f, {4, 3, 2}, 5);
       },
       {.tolerance = kNear}},
      {"a color's pnoise of a point",
       AT "c = pnoise(q, point (4, 3, 2));",
       [](float i) {
         return rsl::pnoise3(noiseAt(i), {4, 3, 2});
       },
       {.tolerance = kNear}},
      {"cellnoise of a number", "x = cellnoise(s / 2);", [](float i) { return rsl::cellnoise(i / 2); }},
      {"cellnoise is one number a cell", "x = cellnoise(floor(s / 2) + 0.1) - cellnoise(floor(s / 2) + 0.9);", 0},
      {"cellnoise of two numbers",
       "x = cellnoise(s / 2, s / 3);",
       [](float i) { return rsl::cellnoise(i / 2, i / 3); },
       {.tolerance = kNear}},
      {"cellnoise of a point", AT "x = cellnoise(q);", [](float i) { return rsl::cellnoise(noiseAt(i)); }},
      {"cellnoise of a point and a number", AT "x = cellnoise(q, s);",
       [](float i) { return rsl::cellnoise(noiseAt(i), i); }},
      {"a color's cellnoise", AT "c = cellnoise(q);", [](float i) { return rsl::cellnoise3(noiseAt(i)); }},
      {"cellnoise is in [0, 1)", "float a = cellnoise(s); if (a >= 0 && a < 1) x = 1;", 1},
      {"wnoise without a width is noise", AT "if (abs(wnoise(q, 0)) < 10) x = 1;", 1},
      {"a sum of octaves",
       AT "float k, f = 1; for (k = 0; k < 3; k += 1) { x += noise(q * f) / f; f *= 2; }",
       [](float i) { return rsl::noise(noiseAt(i)) + rsl::noise(2 * noiseAt(i)) / 2 + rsl::noise(4 * noiseAt(i)) / 4; },
       {.tolerance = 5e-5f}},
  };
  return kCases;
}

}  // namespace tomales::compiler
