// Colors and their spaces (RISpec 3.2 section 15.3).
#include "reyes/shader/shadeops.h"
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {

Cases colorCases() {
  static const Case kCases[] = {
      {"comp", "x = comp(color (1, s, 3), 1);", [](float i) { return i; }},
      {"comp beyond the last component takes the last", "x = comp(color (1, 2, 3), 7);", 3},
      {"ctransform into hsv", "c = ctransform(\"hsv\", color (0.2, 0.4, s / 1000));",
       [](float i) {
         return rsl::ctransform("rgb", "hsv", {0.2f, 0.4f, i / 1000});
       }},
      {"ctransform from hsv", "c = ctransform(\"hsv\", \"rgb\", color (s / 1000, 1, 1));",
       [](float i) {
         return rsl::ctransform("hsv", "rgb", {i / 1000, 1, 1});
       }},
      {"ctransform of a number that is cast", "c = ctransform(\"hsv\", color s);",
       [](float i) {
         return Vec3{0, 0, i};
       }},
      {"a number in hsv", "c = color \"hsv\" 1;", Vec3{1, 0, 0}},
      {"a component by its index", "x = Cs[0] + 10 * Cs[mod(s, 3)];",
       [](float i) {
         const int k = static_cast<int>(i) % 3;
         return 0.25f + 10 * (k == 0 ? 0.25f : k == 1 ? 0.5f : 1);
       }},
      {"a component is assigned by its index", "c[1] = s; c[2] += 2;",
       [](float i) {
         return Vec3{0, i, 2};
       }},
      {"a component of an element", "color a[2] = {1, color (1, 2, 3)}; a[1][0] = s; c = a[1]; x = a[0][2];",
       [](float i) {
         return Vec3{i, 2, 3};
       }},
      {"hsv of a grey", "c = ctransform(\"hsv\", color (0.3, 0.3, 0.3));", Vec3{0, 0, 0.3f}},
      {"hsv of green", "c = ctransform(\"hsv\", color (0, 1, 0));", Vec3{1.0f / 3, 1, 1}},
      {"ctransform into hsl", "c = ctransform(\"hsl\", color (0.2, 0.4, s / 1000));",
       [](float i) {
         return rsl::ctransform("rgb", "hsl", {0.2f, 0.4f, i / 1000});
       }},
      {"hsl of white", "c = ctransform(\"hsl\", color (1, 1, 1));", Vec3{0, 0, 1}},
      {"ctransform into YIQ", "c = ctransform(\"YIQ\", color (1, 1, 1));", Vec3{1, 0, 0}, {.tolerance = 1e-3f}},
      {"YIQ and back",
       "c = ctransform(\"YIQ\", \"rgb\", ctransform(\"YIQ\", color (0.2, 0.4, 0.6)));",
       Vec3{0.2f, 0.4f, 0.6f},
       {.tolerance = 1e-3f}},
      {"xyz and back",
       "c = ctransform(\"xyz\", \"rgb\", ctransform(\"xyz\", color (0.2, 0.4, s)));",
       [](float i) {
         return Vec3{0.2f, 0.4f, i};
       },
       {.tolerance = 1e-4f}},
      {"xyY and back",
       "c = ctransform(\"xyY\", \"rgb\", ctransform(\"xyY\", color (0.2, 0.4, 0.6)));",
       Vec3{0.2f, 0.4f, 0.6f},
       {.tolerance = 1e-4f}},
      {"Y of white is 1", "x = comp(ctransform(\"xyz\", color (1, 1, 1)), 1);", 1, {.tolerance = 1e-4f}},
      {"a space is a text that is computed", "string a = concat(\"h\", \"sv\"); c = ctransform(a, color (0, 1, 0));",
       Vec3{1.0f / 3, 1, 1}},
      {"an unknown space counts as rgb, with a message",
       "c = ctransform(\"lab\", color (1, 2, 3));",
       Vec3{1, 2, 3},
       {.message = "color space \"lab\", which is unknown"}},
      {"a cast from an unknown space is told, too",
       "c = color \"HSV\" (1, 2, 3);",
       Vec3{1, 2, 3},
       {.message = "color space \"HSV\", which is unknown"}},
      {"rgb to rgb", "c = ctransform(\"rgb\", color (1, 2, s));",
       [](float i) {
         return Vec3{1, 2, i};
       }},
      {"products of colors keep what is over 1", "c = color (2, 3, 4) * color (s, s, s);",
       [](float i) {
         return Vec3{2 * i, 3 * i, 4 * i};
       }},
  };
  return kCases;
}

}  // namespace tomales::compiler
