// Arrays (RISpec 3.2 section 11.2.5): indices that are constant, uniform and varying, and out of bounds.
#include <cmath>

#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {

Cases arrayCases() {
  static const Case kCases[] = {
      {"elements in order", "float a[3] = {5, 6, 7}; x = a[0] * 100 + a[1] * 10 + a[2];", 567},
      {"a length that is computed", "float a[(1 + 2) * 2 - 1]; x = arraylength(a);", 5},
      {"elements without a value are 0", "float a[3]; x = a[0] + a[1] + a[2] + s;", [](float i) { return i; }},
      {"fewer values than elements", "float a[3] = {5, 6}; x = a[0] * 100 + a[1] * 10 + a[2];", 560},
      {"an index that varies", "float a[4] = {5, 6, 7, 8}; x = a[mod(s, 4)];",
       [](float i) { return 5 + std::fmod(i, 4.0f); }},
      {"an index is cut to a whole number", "float a[3] = {5, 6, 7}; x = a[1.9];", 6},
      {"an index that varies between whole numbers", "float a[3] = {5, 6, 7}; x = a[mod(s, 3) + 0.5];",
       [](float i) { return 5 + std::fmod(i, 3.0f); }},
      {"an index beyond the end takes the last element",
       "float a[3] = {5, 6, 7}; x = a[3 + s];",
       7,
       {.message = "array"}},
      {"an index below 0 takes the first element", "float a[3] = {5, 6, 7}; x = a[-1 - s];", 5, {.message = "array"}},
      {"an element is assigned", "float a[3] = {5, 6, 7}; a[1] = s; x = a[0] + a[1] + a[2];",
       [](float i) { return 12 + i; }},
      {"elements are assigned by an index that varies",
       "float a[3] = {5, 6, 7}; a[mod(s, 3)] = 1; x = a[0] * 100 + a[1] * 10 + a[2];",
       [](float i) {
         const float k = std::fmod(i, 3.0f);
         return k == 0 ? 167.0f : k == 1 ? 517.0f : 561.0f;
       }},
      {"elements are assigned at some points", "float a[2] = {1, 2}; if (s > 3) a[0] = 9; x = a[0] * 10 + a[1];",
       [](float i) { return i > 3 ? 92.0f : 12.0f; }},
      {"an element is added to", "float a[2] = {1, 2}; a[1] += s; x = a[1];", [](float i) { return 2 + i; }},
      {"colors", "color a[2] = {color (1, 2, 3), color (4, 5, 6)}; c = a[1] - a[0];", Vec3{3, 3, 3}},
      {"colors by an index that varies", "color a[2] = {color (1, 2, 3), color (4, 5, 6)}; c = a[mod(s, 2)];",
       [](float i) {
         return std::fmod(i, 2.0f) == 0 ? Vec3{1, 2, 3} : Vec3{4, 5, 6};
       }},
      {"points that vary", "point a[2] = {P, point (0, 0, 0)}; w = a[0] - a[1];",
       [](float i) {
         return Vec3{i, 2 * i, 3};
       }},
      {"texts", "string a[2] = {\"one\", \"two\"}; if (a[1] == \"two\") x = 1;", 1},
      {"matrices", "matrix a[2]; a[0] = 2; a[1] = 3; w = vtransform(a[1], vector P);",
       [](float i) {
         return Vec3{3 * i, 6 * i, 9};
       }},
      {"the length", "float a[5]; x = arraylength(a) + a[0];", 5},
      {"the length comes of the values", "float a[] = {1, 2, 3, 4}; x = arraylength(a) * 10 + a[3];", 44},
      {"a loop over an array", "float a[4] = {1, 2, 3, 4}; float k; for (k = 0; k < 4; k += 1) x += a[k] * s;",
       [](float i) { return 10 * i; }},
      {"an array is filled in a loop",
       "float a[4]; float k; for (k = 0; k < 4; k += 1) a[k] = k * k; x = a[3] * 10 + a[2];", 94},
      {"an array is turned round in a loop",
       "float a[4] = {1, 2, 3, 4}; float k; for (k = 0; k < 2; k += 1) { float h = a[k]; a[k] = a[3 - k]; a[3 - k] = "
       "h; } x = ((a[0] * 10 + a[1]) * 10 + a[2]) * 10 + a[3];",
       4321},
      {"an element is an index", "float a[3] = {2, 0, 1}; x = a[a[a[0]]] + s;", [](float i) { return i; }},
      {"an array that varies, sorted",
       "float a[3]; a[0] = mod(s, 3); a[1] = mod(s + 1, 3); a[2] = mod(s + 2, 3); float j, k; for (j = 0; j < 2; j += "
       "1) for (k = 0; k < 2; k += 1) "
       "if (a[k] > a[k + 1]) { float h = a[k]; a[k] = a[k + 1]; a[k + 1] = h; } x = a[0] * 100 + a[1] * 10 + a[2];",
       12},
      {"an array in a loop's round starts anew",
       "float k; for (k = 0; k < 3; k += 1) { float a[2]; a[0] += 1; x += a[0]; }", 3},
      {"a parameter that is an array",
       "x = p[0] * 100 + p[1] * 10 + p[2];",
       345,
       {.parameters = "float p[3] = {3, 4, 5};"}},
      {"a parameter that is an array, by an index that varies",
       "x = p[mod(s, 3)];",
       [](float i) { return 3 + std::fmod(i, 3.0f); },
       {.parameters = "float p[3] = {3, 4, 5};"}},
      {"a parameter that is an array of colors",
       "c = p[1];",
       Vec3{0, 1, 0},
       {.parameters = "color p[2] = {color (1, 0, 0), color (0, 1, 0)};"}},
      {"a component of an element", "color a[2] = {color (1, 2, 3), color (4, 5, 6)}; x = comp(a[1], 2);", 6},
      {"a component of an element is set",
       "color a[2] = {color (1, 2, 3), color (4, 5, 6)}; setcomp(a[1], 2, s); c = a[1];",
       [](float i) {
         return Vec3{4, 5, i};
       }},
  };
  return kCases;
}

}  // namespace tomales::compiler
