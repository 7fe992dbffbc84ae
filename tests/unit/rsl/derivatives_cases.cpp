// Derivatives (RISpec 3.2 section 15.1). Over one micropolygon s changes by 1 along u (du = 1/4), t by 3 along v (dv =
// 1/2) and P by (1, 0, 0) and (0, 2, 0): Du(s) = 4, Dv(t) = 6, Du(P) = (4, 0, 0), Dv(P) = (0, 4, 0).
#include <cmath>

#include "reyes/shader/noise.h"
#include "reyes/shader/shadeops.h"
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
namespace {
constexpr CaseOptions kAnalytic = {.tolerance = 1e-4f};
/// Differences of a function that bends over a micropolygon.
constexpr CaseOptions kDifference = {.tolerance = 2e-2f};
float slope(const std::function<float(float)>& f, float at) { return (f(at + 0.01f) - f(at - 0.01f)) / 0.02f; }
}  // namespace

Cases derivativeCases() {
  static const Case kCases[] = {
      {"Du of what the host knows", "x = Du(s);", 4},
      {"Dv of what does not change along v", "x = Dv(s);", 0},
      {"Dv", "x = Dv(t);", 6},
      {"Du of all components", "x = Du(P) . vector (1, 1, 1);", 4},
      {"Du of a point", "w = Du(P);", Vec3{4, 0, 0}},
      {"Dv of a point", "w = Dv(P);", Vec3{0, 4, 0}},
      {"a constant does not change", "x = Du(3) + Dv(7);", 0},
      {"a uniform value does not change", "uniform float k = 5; x = Du(k * k);", 0},
      {"a sum", "x = Du(s + t) + 10 * Dv(s + t);", 64, kAnalytic},
      {"a difference", "x = Dv(s - t);", -6, kAnalytic},
      {"a product", "x = Du(s * s);", [](float i) { return 8 * i; }, kAnalytic},
      {"a product of two that change", "x = Du(s * t) + Dv(s * t);", [](float i) { return -4 * i + 6 * i; }, kAnalytic},
      {"a quotient", "x = Du(1 / (s + 1));", [](float i) { return -4 / ((i + 1) * (i + 1)); }, kAnalytic},
      {"minus", "x = Du(-s);", -4, kAnalytic},
      {"a variable", "float a = s * s; x = Du(a);", [](float i) { return 8 * i; }, kAnalytic},
      {"a variable that is assigned twice", "float a = s; a = a * a; x = Du(a);", [](float i) { return 8 * i; },
       kAnalytic},
      {"a variable's change where it is asked", "float a = s; x = Du(a); a = s * s; x += Du(a);",
       [](float i) { return 4 + 8 * i; }, kAnalytic},
      {"+=", "float a = s; a += s * s; x = Du(a);", [](float i) { return 4 + 8 * i; }, kAnalytic},
      {"sqrt", "x = Du(sqrt(s + 1));", [](float i) { return 2 / std::sqrt(i + 1); }, kAnalytic},
      {"inversesqrt", "x = Du(inversesqrt(s + 1));", [](float i) { return -2 * std::pow(i + 1, -1.5f); }, kAnalytic},
      {"exp", "x = Du(exp(-s));", [](float i) { return -4 * std::exp(-i); }, kAnalytic},
      {"log", "x = Du(log(s + 1));", [](float i) { return 4 / (i + 1); }, kAnalytic},
      {"sin", "x = Du(sin(s));", [](float i) { return 4 * std::cos(i); }, kAnalytic},
      {"cos", "x = Du(cos(s));", [](float i) { return -4 * std::sin(i); }, kAnalytic},
      {"tan", "x = Du(tan(mod(s, 3) / 4));",
       [](float i) {
         const float y = std::tan(std::fmod(i, 3.0f) / 4);
         return 1 + y * y;
       },
       kAnalytic},
      {"atan", "x = Du(atan(s));", [](float i) { return 4 / (1 + i * i); }, kAnalytic},
      {"atan of two", "x = Du(atan(s, 2));", [](float i) { return 8 / (4 + i * i); }, kAnalytic},
      {"pow", "x = Du(pow(s + 1, 1.5));", [](float i) { return 6 * std::sqrt(i + 1); }, kAnalytic},
      {"pow with an exponent that changes", "x = Du(pow(2, s / 100));",
       [](float i) { return 4 * std::log(2.0f) / 100 * std::pow(2.0f, i / 100); }, kAnalytic},
      {"mod", "x = Du(mod(s, 4));", 4, kAnalytic},
      {"abs", "x = Du(abs(s - 3.5));", [](float i) { return i < 3.5f ? -4.0f : 4.0f; }, kAnalytic},
      {"min", "x = Du(min(s, 3.5));", [](float i) { return i < 3.5f ? 4.0f : 0.0f; }, kAnalytic},
      {"max", "x = Du(max(s, 3.5));", [](float i) { return i < 3.5f ? 0.0f : 4.0f; }, kAnalytic},
      {"clamp", "x = Du(clamp(s, 1.5, 3.5));", [](float i) { return i > 1.5f && i < 3.5f ? 4.0f : 0.0f; }, kAnalytic},
      {"mix", "x = Du(mix(2, 5, s));", 12, kAnalytic},
      {"mix of what changes", "x = Du(mix(s, s * s, 0.5));", [](float i) { return 2 + 4 * i; }, kAnalytic},
      {"floor does not change", "x = Du(floor(s));", 0},
      {"step does not change", "x = Du(step(2, s));", 0},
      {"smoothstep, by differences", "x = Du(smoothstep(-1000, 1000, s));",
       [](float i) { return 4 * slope([](float y) { return 2000 * rsl::smoothstep(-1000, 1000, y); }, i) / 2000; },
       kDifference},
      {"a component", "x = Du(xcomp(P)) + Dv(ycomp(P));", 8, kAnalytic},
      {"a triplet of what changes", "w = Du(vector (s, s * s, t));",
       [](float i) {
         return Vec3{4, 8 * i, 0};
       },
       kAnalytic},
      {"a color", "c = Du(color (s, 2 * s, 1));", Vec3{4, 8, 0}, kAnalytic},
      {"a dot product", "x = Du(P . P);", [](float i) { return 8 * i; }, kAnalytic},
      {"a cross product", "w = Du(vector P ^ vector (0, 0, 1));", Vec3{0, -4, 0}, kAnalytic},
      {"length", "x = Du(length(P));", [](float i) { return 4 * i / std::sqrt(5 * i * i + 9); }, kAnalytic},
      {"normalize", "w = Du(normalize(vector (s, 1, 0)));",
       [](float i) {
         const float k = std::pow(i * i + 1, -1.5f);
         return Vec3{4 * k, -4 * i * k, 0};
       },
       kAnalytic},
      {"distance", "x = Du(distance(P, point (0, 0, 3)));",
       [](float i) { return 4 * i / std::max(1e-9f, std::sqrt(5 * i * i)); }, kAnalytic},
      {"a transformation by a matrix", "matrix m = scale((matrix 1), point (2, 2, 2)); w = Du(transform(m, P));",
       Vec3{8, 0, 0}, kAnalytic},
      {"a transformation by a multiple of the identity",
       "matrix m = translate((matrix 2), vector (1, 2, 3)); w = Du(transform(m, P));", Vec3{4, 0, 0}, kAnalytic},
      {"a projection",
       "matrix m = matrix (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0); w = Du(transform(m, point (s, 1, s + 2)));",
       [](float i) {
         return 4 / ((i + 2) * (i + 2)) * Vec3{2, -1, 0};
       },
       kAnalytic},
      {"a projection from infinity, where nothing is divided",
       "matrix m = matrix (2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0); w = Du(transform(m, P));", Vec3{8, 0, 0},
       kAnalytic},
      {"a space", "w = Du(transform(\"world\", P));", Vec3{8, 0, 0}, {.tolerance = 1e-3f}},
      {"both sides of a choice", "x = Du(s < 3 ? s : s * s);", [](float i) { return i < 3 ? 4 : 8 * i; }, kAnalytic},
      {"through if", "float a; if (s < 3) a = s; else a = s * s; x = Du(a);", [](float i) { return i < 3 ? 4 : 8 * i; },
       kAnalytic},
      {"within if", "float a = s * s; if (s < 3) x = Du(a); else x = -Du(a);",
       [](float i) { return i < 3 ? 8 * i : -8 * i; }, kAnalytic},
      {"through a loop", "float a = 1, k; for (k = 0; k < 3; k += 1) a *= (s / 100); x = Du(a);",
       [](float i) { return 12 * i * i / 1e6f; }, kAnalytic},
      {"through a loop whose count varies", "float a = 0, k; for (k = 0; k < mod(s, 4); k += 1) a += s; x = Du(a);",
       [](float i) { return 4 * std::fmod(i, 4.0f); }, kAnalytic},
      {"within a loop", "float a = s, k; for (k = 0; k < 3; k += 1) { x += Du(a); a += s; }", 24, kAnalytic},
      {"through a function", "float f(float a) { return a * a; } x = Du(f(s));", [](float i) { return 8 * i; },
       kAnalytic},
      {"through a function with two returns", "float f(float a) { if (a < 3) return a; return a * a; } x = Du(f(s));",
       [](float i) { return i < 3 ? 4 : 8 * i; }, kAnalytic},
      {"through an output", "void f(output float a) { a = s * s; } float y = 0; f(y); x = Du(y);",
       [](float i) { return 8 * i; }, kAnalytic},
      {"through an array", "float a[2]; a[0] = s; a[1] = s * s; x = Du(a[0]) + Du(a[1]);",
       [](float i) { return 4 + 8 * i; }, kAnalytic},
      {"through an array by an index that varies", "float a[2]; a[0] = s; a[1] = s * s; x = Du(a[mod(s, 2)]);",
       [](float i) { return std::fmod(i, 2.0f) == 0 ? 4 : 8 * i; }, kAnalytic},
      {"through setcomp", "vector a = (0, 0, 0); setxcomp(a, s); setcomp(a, 2, s * s); w = Du(a);",
       [](float i) {
         return Vec3{4, 0, 8 * i};
       },
       kAnalytic},
      {"of an output of the shader", "x = s * s; x = Du(x);", [](float i) { return 8 * i; }, kAnalytic},
      {"through noise",
       "point q = P / 100 + vector (0, 0, 0.3); x = Du(noise(q));",
       [](float i) {
         return 4 * slope([&](float y) { return 50 * rsl::noise(Vec3{y / 100, 2 * i / 100, 0.33f}); }, i) / 50;
       },
       {.tolerance = 4e-3f}},
      {"Deriv", "x = Deriv(s * s, s);", [](float i) { return 2 * i; }, kAnalytic},
      {"Deriv of a color", "c = Deriv(color (s * s, t, 1), s);",
       [](float i) {
         return Vec3{2 * i, 0, 0};
       },
       kAnalytic},
      {"Deriv by what changes along both", "x = Deriv(s + t, s + 2 * t);", 1.5f, kAnalytic},
      {"Deriv of a point", "w = Deriv(P, s);", Vec3{1, 0, 0}, kAnalytic},
      {"Deriv by what does not change", "x = Deriv(s, 3);", 0},
      {"area", "x = area(P);", 2, kAnalytic},
      {"area of points that have moved", "x = area(P * 3);", 18, kAnalytic},
      {"calculatenormal", "w = calculatenormal(P);", Vec3{0, 0, -1}, kAnalytic},
      {"calculatenormal of a slope", "w = calculatenormal(P + vector (0, 0, s));", rsl::normalize({1, 0, -1}),
       kAnalytic},
      {"filterstep's middle", "x = filterstep(s, s);", 0.5f, kAnalytic},
      {"filterstep's width is that of a micropolygon", "x = filterstep(3, s);",
       [](float i) { return i < 3    ? 0.0f
                            : i == 3 ? 0.5f
                                     : 1.0f; }, kAnalytic},
      {"filterstep with a wider filter", "x = filterstep(3, s, \"width\", 4);",
       [](float i) { return std::min(1.0f, std::max(0.0f, (i + 2 - 3) / 4)); }, kAnalytic},
      {"filterstep over a range", "x = filterstep(3, s, s + 4);",
       [](float i) { return std::min(1.0f, std::max(0.0f, (i + 4 - 3) / 4)); }, kAnalytic},
      {"filterstep with a name of a filter", "x = filterstep(3, s, \"filter\", \"box\");",
       [](float i) { return i < 3    ? 0.0f
                            : i == 3 ? 0.5f
                                     : 1.0f; }, kAnalytic},
      {"derivatives of derivatives", "x = Du(s * Du(s));", 16, kAnalytic},
      {"a texture's change", "x = Du(texture(\"a\", s, t));", 4, {.tolerance = 1e-3f}},
      {"light does not change", "x = Du(comp(ambient(), 2));", 0},
  };
  return kCases;
}

}  // namespace tomales::compiler
