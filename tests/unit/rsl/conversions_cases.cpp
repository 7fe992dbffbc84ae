// Conversions, casts, and overloads by the result that is wanted (RISpec 3.2 sections 11.2 and 15).
#include "reyes/shader/noise.h"
#include "reyes/shader/shadeops.h"
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
Cases conversionCases() {
  static const Case kCases[] = {
      {"a number becomes a grey", "c = s;",
       [](float i) {
         return Vec3{i, i, i};
       }},
      {"a number becomes a vector of equal components", "w = 2;", Vec3{2, 2, 2}},
      {"a number is cast", "c = color (s + 1);",
       [](float i) {
         return Vec3{i + 1, i + 1, i + 1};
       }},
      {"a cast of a name without brackets", "c = color s;",
       [](float i) {
         return Vec3{i, i, i};
       }},
      {"a triplet is what the other side is", "color a = (1, s, 3); c = a;",
       [](float i) {
         return Vec3{1, i, 3};
       }},
      {"a color's components", "c = color (s, s * 2, 3);", at},
      {"a color in hsv", "c = color \"hsv\" (0.25, 0.5, 0.75);", rsl::ctransform("hsv", "rgb", {0.25f, 0.5f, 0.75f})},
      {"a color in hsv that varies", "c = color \"hsv\" (s / 1000, 0.5, 0.75);",
       [](float i) {
         return rsl::ctransform("hsv", "rgb", {i / 1000, 0.5f, 0.75f});
       }},
      {"a color in hsl", "c = color \"hsl\" (s / 1000, 0.5, 0.25);",
       [](float i) {
         return rsl::ctransform("hsl", "rgb", {i / 1000, 0.5f, 0.25f});
       }},
      {"a color in YIQ", "c = color \"YIQ\" (0.5, 0.1, 0.2);", rsl::ctransform("YIQ", "rgb", {0.5f, 0.1f, 0.2f})},
      {"a color in xyz", "c = color \"xyz\" (0.3, 0.4, 0.5);", rsl::ctransform("xyz", "rgb", {0.3f, 0.4f, 0.5f})},
      {"a color in xyY", "c = color \"xyY\" (0.3, 0.4, 0.5);", rsl::ctransform("xyY", "rgb", {0.3f, 0.4f, 0.5f})},
      {"a color in rgb", "c = color \"rgb\" (0.3, 0.4, s);",
       [](float i) {
         return Vec3{0.3f, 0.4f, i};
       }},
      {"pure red in hsv", "c = color \"hsv\" (0, 1, 1);", Vec3{1, 0, 0}},
      {"pure blue in hsv",
       "c = color \"hsv\" (2 / 3, 1, s);",
       [](float i) {
         return Vec3{0, 0, i};
       },
       {.tolerance = 1e-5f}},
      {"a point in the world", "point Q = point \"world\" (s, 1, 2); w = vector Q;",
       [](float i) {
         return Vec3{i, 1, 2};
       }},
      {"a point in the current space", "w = vector (point \"current\" (s, 1, 2));",
       [](float i) {
         return Vec3{i, 1, 2};
       }},
      {"a vector in a space", "w = vector \"world\" (s, 1, 2);",
       [](float i) {
         return Vec3{i, 1, 2};
       }},
      {"a normal in a space", "w = normal \"world\" (s, 1, 2);",
       [](float i) {
         return Vec3{i, 1, 2};
       }},
      {"a point is cast to a vector", "w = vector P;", at},
      {"a vector is cast to a color", "c = color (vector (s, 2, 3));",
       [](float i) {
         return Vec3{i, 2, 3};
       }},
      {"points are assigned to vectors", "w = P;", at},
      {"normals and vectors go together", "vector a = (0, 0, s); normal n = a; w = n;",
       [](float i) {
         return Vec3{0, 0, i};
       }},
      {"a float cast of a call", "x = float noise(P);", [](float i) { return rsl::noise(at(i)); }},
      {"a color cast of a call", "c = color noise(P);", [](float i) { return rsl::noise3(at(i)); }},
      {"a color is wanted, a color is taken", "c = noise(P);", [](float i) { return rsl::noise3(at(i)); }},
      {"a number is wanted, a number is taken", "x = noise(P);", [](float i) { return rsl::noise(at(i)); }},
      {"what is wanted goes down through a sum", "c = 1 + noise(P);",
       [](float i) {
         return Vec3{1, 1, 1} + rsl::noise3(at(i));
       }},
      {"what is wanted goes down beside a triple in a sum", "c = color (1, 1, 1) + noise(P);",
       [](float i) {
         return Vec3{1, 1, 1} + rsl::noise3(at(i));
       }},
      {"noise that moves a point", "point q = P + .1 * noise(P); w = vector q;",
       [](float i) { return at(i) + 0.1f * rsl::noise3(at(i)); }},
      {"what is wanted goes down through brackets and minus", "c = -(noise(P));",
       [](float i) { return -rsl::noise3(at(i)); }},
      {"what is wanted goes down through a choice", "c = s < 3 ? noise(P) : noise(s);",
       [](float i) { return i < 3 ? rsl::noise3(at(i)) : rsl::noise3(i); }},
      {"what is wanted goes down to one side of a choice", "c = s < 3 ? 0 : noise(P);",
       [](float i) {
         return i < 3 ? Vec3{0, 0, 0} : rsl::noise3(at(i));
       }},
      {"what is wanted goes down to the other side of a choice", "c = s < 3 ? noise(P) : 1;",
       [](float i) {
         return i < 3 ? rsl::noise3(at(i)) : Vec3{1, 1, 1};
       }},
      {"noise beside a triple is a number", "w = N * noise(P);",
       [](float i) {
         return rsl::noise(at(i)) * Vec3{0, 0, -1};
       }},
      {"noise before a triple is a number",
       "point Q = P + noise(P) * N; w = Q - P;",
       [](float i) {
         return rsl::noise(at(i)) * Vec3{0, 0, -1};
       },
       {.tolerance = 1e-4f}},
      {"noise in a declaration", "color a = noise(s); c = a;", [](float i) { return rsl::noise3(i); }},
      {"noise in a condition is a number", "if (noise(P) >= 0) x = 1;", 1},
      {"noise as an argument of a function is what that takes", "x = sqrt(noise(P));",
       [](float i) { return std::sqrt(rsl::noise(at(i))); }},
      {"noise as an argument that is a color", "color f(color a) { return a; } c = f(noise(P));",
       [](float i) { return rsl::noise3(at(i)); }},
      {"noise in a float function's return", "float f() { return noise(s); } x = f();",
       [](float i) { return rsl::noise(i); }},
      {"noise in a color function's return", "color f() { return noise(s); } c = f();",
       [](float i) { return rsl::noise3(i); }},
      {"noise in a +=", "c = 0; c += noise(s);", [](float i) { return rsl::noise3(i); }},
      {"a texture that is a number", "x = texture(\"a\", s, t);", [](float i) { return i; }},
      {"a texture that is a color", "c = texture(\"a\", s, t);",
       [](float i) {
         return Vec3{i, -i, 0};
       }},
      {"a texture in a color's product is a color", "c = color (1, 2, 3) * texture(\"a\", s, t);",
       [](float i) {
         return Vec3{i, -2 * i, 0};
       }},
      {"a texture in minus a color's product is a color", "c = -(color (1, 2, 3) * texture(\"a\", s, t));",
       [](float i) {
         return Vec3{-i, 2 * i, 0};
       }},
      {"a texture in brackets in a color's product is a color",
       "c = color (1, 2, 3) * (1 - .5 * texture(\"a\", s, t));",
       [](float i) {
         return Vec3{1 - i / 2, 2 + i, 3};
       }},
      {"a texture that is mixed in a color's product is a color",
       "c = color (1, 2, 3) * mix(texture(\"a\", s, t), 0, .5);",
       [](float i) {
         return Vec3{i / 2, -i, 0};
       }},
      {"a texture that is chosen in a color's product is a color",
       "c = color (1, 2, 3) * (s < 3 ? 0 : texture(\"a\", s, t));",
       [](float i) {
         return i < 3 ? Vec3{0, 0, 0} : Vec3{i, -2 * i, 0};
       }},
      {"a texture in a function of a number stays one", "c = color (1, 2, 3) * sqrt(texture(\"a\", s, t));",
       [](float i) {
         return std::sqrt(i) * Vec3{1, 2, 3};
       }},
      {"noise at a texture in a color's product is a number", "c = color (1, 2, 3) * noise(texture(\"a\", s, t));",
       [](float i) {
         return rsl::noise(i) * Vec3{1, 2, 3};
       }},
      {"noise beside a texture in a color's product is a number",
       "c = color (1, 2, 3) * max(noise(P), texture(\"a\", s, t));",
       [](float i) {
         return std::max(rsl::noise(at(i)), i) * Vec3{1, 2, 3};
       }},
      {"noise that a texture chooses in a color's product is a number",
       "c = color (1, 2, 3) * (texture(\"a\", s, t) > 2 ? noise(P) : 1);",
       [](float i) {
         return (i > 2 ? rsl::noise(at(i)) : 1.0f) * Vec3{1, 2, 3};
       }},
      {"a texture cast to a number in a color's product", "c = color (1, 2, 3) * float texture(\"a\", s, t);",
       [](float i) {
         return Vec3{i, 2 * i, 3 * i};
       }},
      {"a texture's channel", "c = color texture(\"a\"[1], s, t);",
       [](float i) {
         return Vec3{i, -i, 1};
       }},
      {"an environment that is a number", "x = environment(\"a\", vector (s, 1, 2));", [](float i) { return i; }},
      {"an environment that is a color", "c = environment(\"a\", vector (s, 1, 2));",
       [](float i) {
         return Vec3{i, 1, 2};
       }},
      {"a shadow that is a number", "x = shadow(\"a\", P);", [](float i) { return i; }},
      {"mix of numbers in a color", "c = mix(color (0, 0, 0), color (s, 2, 4), 0.5);",
       [](float i) {
         return Vec3{i / 2, 1, 2};
       }},
      {"a number where a function takes a color", "color f(color a) { return a * color (1, 2, 3); } c = f(s);",
       [](float i) {
         return Vec3{i, 2 * i, 3 * i};
       }},
      {"a variable without a value is 0", "float a; color b; x = a + s; c = b;", [](float i) { return i; }},
  };
  return kCases;
}

}  // namespace tomales::compiler
