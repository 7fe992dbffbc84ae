// Mathematics (RISpec 3.2 section 15.1), against the C library and the functions that C++ shaders use.
#include <cmath>
#include <limits>

#include "reyes/shader/noise.h"
#include "reyes/shader/shadeops.h"
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
namespace {
/// Numbers around 0 from the point's.
float around(float i) { return std::fmod(i, 9.0f) / 2 - 2; }
#define AROUND "float a = mod(s, 9) / 2 - 2; "
}  // namespace

Cases mathematicsCases() {
  static const float kKnots[] = {1, 3, 2, 5, 4, 7, 6};
  static const Case kCases[] = {
      {"radians", "x = radians(180 + s);", [](float i) { return (180 + i) * 0.0174532925f; }},
      {"degrees", "x = degrees(PI * s);", [](float i) { return 180 * i; }},
      {"sin", AROUND "x = sin(a);", [](float i) { return std::sin(around(i)); }},
      {"cos", AROUND "x = cos(a);", [](float i) { return std::cos(around(i)); }},
      {"tan", AROUND "x = tan(a / 2);", [](float i) { return std::tan(around(i) / 2); }},
      {"asin", AROUND "x = asin(a / 2);", [](float i) { return std::asin(around(i) / 2); }},
      {"acos", AROUND "x = acos(a / 2);", [](float i) { return std::acos(around(i) / 2); }},
      {"atan of a quotient", AROUND "x = atan(a);", [](float i) { return std::atan(around(i)); }},
      {"atan of two numbers knows all four quarters", AROUND "x = atan(a, -1);",
       [](float i) { return std::atan2(around(i), -1.0f); }},
      {"exp", AROUND "x = exp(a);", [](float i) { return std::exp(around(i)); }},
      {"log", "x = log(s + 1);", [](float i) { return std::log(i + 1); }},
      {"log to a base", "x = log(s + 1, 2);", [](float i) { return std::log2(i + 1); }},
      {"sqrt", "x = sqrt(s);", [](float i) { return std::sqrt(i); }},
      {"inversesqrt", "x = inversesqrt(s + 1);", [](float i) { return 1 / std::sqrt(i + 1); }},
      {"pow", "x = pow(s + 1, 0.5);", [](float i) { return std::sqrt(i + 1); }},
      {"pow of 0 and 0", "x = pow(0, 0);", 1},
      {"pow of a negative number to a whole one", "x = pow(-2, 3);", -8},
      {"clamp looks at its lower limit first", "x = clamp(s, 5, 3 - s);", [](float i) { return i < 5 ? 5 : 3 - i; }},
      {"clamp of colors likewise", "c = clamp(color (1, 7, 2), color 5, color 3);", Vec3{5, 3, 5}},
      {"smoothstep over nothing is a step", "x = smoothstep(4, 4, s);", [](float i) { return i < 4 ? 0.0f : 1.0f; }},
      {"pow of a negative number to a broken one is 0", "x = pow(-s - 1, 0.5);", 0},
      {"pow of 0 to a negative number is 0", "x = pow(s - s, -1);", 0},
      {"sqrt of a negative number is 0", "x = sqrt(-s - 1);", 0},
      {"inversesqrt of 0 and of negative numbers is 0", "x = inversesqrt(-s);", 0},
      {"acos beyond 1 is that of 1", "x = acos(1.0001 + s);", 0},
      {"asin below -1 is that of -1", "x = asin(-1.0001 - s);", -1.5707964f},
      {"log of 0 is the least number", "x = log(s - s);", -std::numeric_limits<float>::max()},
      {"mod by 0 is 0", "x = mod(s + 1, s - s);", 0},
      {"nothing of them is NaN in constant code", "x = pow(-1, .5) + sqrt(-1) + acos(2) + mod(1, 0) + inversesqrt(0);",
       0},
      {"pow of colors", "c = pow(color (s, 2, 3), 2);",
       [](float i) {
         return Vec3{i * i, 4, 9};
       }},
      {"pow of colors by components", "c = pow(color (2, 2, 3), color (1, 2, 3));", Vec3{2, 4, 27}},
      {"mod", "x = mod(s, 4);", [](float i) { return std::fmod(i, 4.0f); }},
      {"mod of negative numbers has the sign of the divisor", "x = mod(-1 - s, 4);",
       [](float i) { return 3 - std::fmod(i, 4.0f); }},
      {"mod by a negative number", "x = mod(1, -4);", -3},
      {"abs", AROUND "x = abs(a);", [](float i) { return std::abs(around(i)); }},
      {"abs of triples", "c = abs(color (-1, 2, -s));",
       [](float i) {
         return Vec3{1, 2, i};
       }},
      {"sign", AROUND "x = sign(a);", [](float i) { return rsl::sign(around(i)); }},
      {"floor", AROUND "x = floor(a);", [](float i) { return std::floor(around(i)); }},
      {"ceil", AROUND "x = ceil(a);", [](float i) { return std::ceil(around(i)); }},
      {"round", AROUND "x = round(a + 0.2);", [](float i) { return std::floor(around(i) + 0.7f); }},
      {"floor of triples", "c = floor(color (1.5, -1.5, s + 0.5));",
       [](float i) {
         return Vec3{1, -2, i};
       }},
      {"min of two", "x = min(s, 3);", [](float i) { return std::min(i, 3.0f); }},
      {"min of many", "x = min(5, s, 3, 4);", [](float i) { return std::min(i, 3.0f); }},
      {"max of many", "x = max(5, s, 3, 4);", [](float i) { return std::max(i, 5.0f); }},
      {"min of colors by components", "c = min(color (1, 5, s), color (3, 2, 4));",
       [](float i) {
         return Vec3{1, 2, std::min(i, 4.0f)};
       }},
      {"max of points", "w = vector max(P, point (3, 3, 3));",
       [](float i) {
         return Vec3{std::max(i, 3.0f), std::max(2 * i, 3.0f), 3};
       }},
      {"clamp", "x = clamp(s, 2, 5);", [](float i) { return std::min(5.0f, std::max(2.0f, i)); }},
      {"clamp between bounds the wrong way round: the lower comes first", "x = clamp(s, 5, 2);",
       [](float i) { return i < 5 ? 5.0f : 2.0f; }},
      {"steps that are held to what is left end a march",
       "float d = 0, step = .4; while (d <= 1) { step = clamp(step, .005, 1 - d); d += step; x += 1; }", 5},
      {"clamp of colors", "c = clamp(color (s, 0, 9), color (1, 1, 1), color (2, 3, 4));",
       [](float i) {
         return Vec3{std::min(2.0f, std::max(1.0f, i)), 1, 4};
       }},
      {"mix", "x = mix(10, 20, s / 10);", [](float i) { return 10 + i; }},
      {"mix of colors by a color", "c = mix(color (0, 0, 0), color (2, 4, 8), color (0, 0.5, s));",
       [](float i) {
         return Vec3{0, 2, 8 * i};
       }},
      {"step", "x = step(3, s);", [](float i) { return i < 3 ? 0.0f : 1.0f; }},
      {"smoothstep", "x = smoothstep(2, 6, s);",
       [](float i) {
         const float t = std::min(1.0f, std::max(0.0f, (i - 2) / 4));
         return t * t * (3 - 2 * t);
       }},
      {"smoothstep's middle", "x = smoothstep(0, 1, 0.5);", 0.5f},
      {"erf", AROUND "x = erf(a);", [](float i) { return std::erf(around(i)); }},
      {"erfc", AROUND "x = erfc(a);", [](float i) { return std::erfc(around(i)); }},
      {"random is in [0, 1)", "float a = random(); if (a >= 0 && a < 1) x = 1;", 1},
      {"random is another number at each call", "if (random() != random()) x = 1;", 1},
      {"random of colors", "color a = random(); if (comp(a, 0) != comp(a, 1)) x = 1;", 1},
      {"randomgrid is one number for the batch", "uniform float a = randomgrid(); if (a >= 0 && a < 1) x = 1;", 1},
      {"catmull-rom goes through its knots", "x = spline(0.5, 0, 1, 2, 4, 5);", 2},
      {"catmull-rom begins at the second knot", "x = spline(0, 9, 1, 2, 4);", 1},
      {"catmull-rom ends at the last but one", "x = spline(1, 9, 1, 2, 4);", 2},
      {"spline is held beyond its ends", "x = spline(2 + s, 9, 1, 2, 4);", 2},
      {"spline of a value that varies", "x = spline(mod(s, 11) / 10, 1, 3, 2, 5, 4, 7, 6);",
       [](float i) { return rsl::spline(rsl::Basis::CatmullRom, std::fmod(i, 11.0f) / 10, kKnots, 7); }},
      {"bezier", "x = spline(\"bezier\", mod(s, 11) / 10, 1, 3, 2, 5, 4, 7, 6);",
       [](float i) { return rsl::spline(rsl::Basis::Bezier, std::fmod(i, 11.0f) / 10, kKnots, 7); }},
      {"bezier goes through its ends", "x = spline(\"bezier\", 1, 1, 5, 6, 4);", 4},
      {"knots that are numbers and colors",
       "c = spline(s / 1000, color 0, color 0, color (1, 2, 3), color 1, color 1);",
       [](float i) {
         const float x[] = {0, 0, 1, 1, 1}, y[] = {0, 0, 2, 1, 1}, z[] = {0, 0, 3, 1, 1};
         const auto at = [&](const float* knots) { return rsl::spline(rsl::Basis::CatmullRom, i / 1000, knots, 5); };
         return Vec3{at(x), at(y), at(z)};
       }},
      {"b-spline of equal knots", "x = spline(\"b-spline\", 0.3, 2, 2, 2, 2);", 2},
      {"b-spline at a knot", "x = spline(\"b-spline\", 0, 1, 3, 2, 9);", 2.5f},
      {"bspline is the same basis", "x = spline(\"bspline\", 0, 1, 3, 2, 9);", 2.5f},
      {"catrom is catmull-rom", "x = spline(\"catrom\", 0.5, 1, 3, 2, 9) - spline(0.5, 1, 3, 2, 9);", 0},
      {"hermite goes through its points",
       "x = spline(\"hermite\", 0, 1, 5, 6, 4) * 10 + spline(\"hermite\", 1, 1, 5, 6, 4);", 16},
      {"linear", "x = spline(\"linear\", 0.25, 9, 1, 2, 9);", 1.25f},
      {"a solved spline is the inverse", "x = spline(\"solvelinear\", 1.25, 9, 1, 2, 9);", 0.25f},
      {"a spline over an array", "float a[4] = {9, 1, 2, 9}; x = spline(\"linear\", 0.5, a);", 1.5f},
      {"a spline over an array without a basis", "float a[4] = {9, 1, 2, 4}; x = spline(0, a);", 1},
      {"a spline of colors",
       "c = spline(\"linear\", 0.5, color (0, 0, 0), color (1, 2, 3), color (3, 4, s), color (9, 9, 9));",
       [](float i) {
         return Vec3{2, 3, (3 + i) / 2};
       }},
      {"a spline of points over an array", "point a[4] = {P, P, P, P}; w = vector spline(0.5, a);",
       [](float i) {
         return Vec3{i, 2 * i, 3};
       }},
  };
  return kCases;
}

}  // namespace tomales::compiler
