// Parameters of shaders (RISpec 3.2 section 12.1): defaults, and outputs.
#include "reyes/shader/shadeops.h"
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {

Cases parameterCases() {
  static const Case kCases[] = {
      {"a number", "x = p;", 3, {.parameters = "float p = 3;"}},
      {"without a default it is 0", "x = p + s;", [](float i) { return i; }, {.parameters = "float p;"}},
      {"a default is a sum", "x = p;", 7, {.parameters = "float p = 1 + 2 * 3;"}},
      {"a default by a function", "x = p;", 0.523598776f, {.parameters = "float p = radians(30);"}},
      {"a default of PI", "x = p;", 1.57079633f, {.parameters = "float p = PI / 2;"}},
      {"several of one type", "x = p * 10 + q;", 12, {.parameters = "float p = 1, q = 2;"}},
      {"a grey", "c = p;", Vec3{2, 2, 2}, {.parameters = "color p = 2;"}},
      {"a color", "c = p;", Vec3{1, 2, 3}, {.parameters = "color p = color (1, 2, 3);"}},
      {"a triplet", "c = p;", Vec3{1, 2, 3}, {.parameters = "color p = (1, 2, 3);"}},
      {"a color in hsv",
       "c = p;",
       rsl::ctransform("hsv", "rgb", {0.25f, 0.5f, 0.75f}),
       {.parameters = "color p = color \"hsv\" (0.25, 0.5, 0.75);"}},
      {"a point in the shader's space",
       "w = vector p;",
       Vec3{1, 2, 3},
       {.parameters = "point p = point \"shader\" (1, 2, 3);"}},
      {"a point in a space that is computed",
       "w = vector p;",
       Vec3{1, 2, 3},
       {.parameters = "point p = point \"camera\" (1, 2, 3);"}},
      {"a default of a global", "c = p;", Vec3{0.25f, 0.5f, 1}, {.parameters = "color p = Cs;"}},
      {"a default of another parameter", "x = q;", 6, {.parameters = "float p = 3; float q = 2 * p;"}},
      {"a default that varies", "x = p;", [](float i) { return i + 1; }, {.parameters = "varying float p = s + 1;"}},
      {"evalparam assigns a parameter and is 1",
       "float y; x = evalparam(\"p\", y); x += 10 * y;",
       31,
       {.parameters = "float p = 3;"}},
      {"a text", "if (p == \"a\") x = 1;", 1, {.parameters = "string p = \"a\";"}},
      {"a text that is computed", "if (p == \"ab\") x = 1;", 1, {.parameters = "string p = concat(\"a\", \"b\");"}},
      {"an array", "x = p[0] + p[1] * 10;", 21, {.parameters = "float p[2] = {1, 2};"}},
      {"an array of texts", "if (p[1] == \"b\") x = 1;", 1, {.parameters = "string p[2] = {\"a\", \"b\"};"}},
      {"an array that is computed",
       "x = p[0] + p[1] * 10;",
       [](float i) { return i + 10 * (i + 1); },
       {.parameters = "varying float p[2] = {s, s + 1};"}},
      {"an output's default", "x = p; p = 7;", 4, {.parameters = "output varying float p = 4;"}},
      {"an output that is computed",
       "x = p;",
       [](float i) { return 2 * i; },
       {.parameters = "output varying float p = 2 * s;"}},
      {"a parameter is assigned", "p = p + s; x = p;", [](float i) { return 3 + i; }, {.parameters = "float p = 3;"}},
      {"a parameter is assigned at some points",
       "if (s > 2) p = 1; x = p;",
       [](float i) { return i > 2 ? 1.0f : 3.0f; },
       {.parameters = "float p = 3;"}},
      {"a matrix of a number",
       "w = vtransform(p, vector (1, 2, s));",
       [](float i) {
         return Vec3{2, 4, 2 * i};
       },
       {.parameters = "matrix p = 2;"}},
      {"a negative default", "x = p;", -1.5f, {.parameters = "float p = -1.5;"}},
  };
  return kCases;
}

}  // namespace tomales::compiler
