// Points, vectors, normals and spaces (RISpec 3.2 section 15.2).
#include <cmath>

#include "reyes/shader/shadeops.h"
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
namespace {
const Vec3 kDown = rsl::normalize({1, -1, 0});
#define REFRACTED "vector i = normalize(vector (1, -1, 0)); normal n = (0, 1, 0); "
}  // namespace

Cases geometryCases() {
  static const Case kCases[] = {
      {"xcomp", "x = xcomp(P);", [](float i) { return i; }},
      {"ycomp", "x = ycomp(P);", [](float i) { return 2 * i; }},
      {"zcomp", "x = zcomp(P);", 3},
      {"comp by an index that varies", "x = comp(P, mod(s, 3));",
       [](float i) { return std::fmod(i, 3.0f) == 0   ? i
                            : std::fmod(i, 3.0f) == 1 ? 2 * i
                                                      : 3; }},
      {"setxcomp", "w = (1, 2, 3); setxcomp(w, s);",
       [](float i) {
         return Vec3{i, 2, 3};
       }},
      {"setycomp", "w = (1, 2, 3); setycomp(w, s);",
       [](float i) {
         return Vec3{1, i, 3};
       }},
      {"setzcomp", "w = (1, 2, 3); setzcomp(w, s);",
       [](float i) {
         return Vec3{1, 2, i};
       }},
      {"setcomp", "w = (1, 2, 3); setcomp(w, 1, s);",
       [](float i) {
         return Vec3{1, i, 3};
       }},
      {"setcomp at some points", "c = color (1, 2, 3); if (s > 2) setcomp(c, 0, 9);",
       [](float i) {
         return Vec3{i > 2 ? 9.0f : 1, 2, 3};
       }},
      {"setcomp by an index that varies", "c = color (5, 5, 5); setcomp(c, mod(s, 3), 9);",
       [](float i) {
         const float k = std::fmod(i, 3.0f);
         return Vec3{k == 0 ? 9.0f : 5, k == 1 ? 9.0f : 5, k == 2 ? 9.0f : 5};
       }},
      {"length", "x = length(vector (3 * s, 4 * s, 0));", [](float i) { return 5 * i; }},
      {"distance", "x = distance(P, P + vector (0, 3, 4));", 5, {.tolerance = 1e-4f}},
      {"normalize", "w = normalize(vector (0, 0, s + 1));", Vec3{0, 0, 1}},
      {"normalize of nothing", "w = normalize(vector (0, 0, 0));", rsl::normalize({0, 0, 0})},
      {"ptlined beside the segment", "x = ptlined(point (0, 0, 0), point (10, 0, 0), point (5, s, 0));",
       [](float i) { return i; }},
      {"ptlined beyond its end", "x = ptlined(point (0, 0, 0), point (10, 0, 0), point (13, 4, 0));", 5},
      {"rotate by a quarter turn", "w = vector rotate(point (1, 0, 0), PI / 2, point (0, 0, 0), point (0, 0, 1));",
       rsl::rotate({1, 0, 0}, rsl::kPi / 2, {0, 0, 0}, {0, 0, 1})},
      {"rotate around an axis beside the origin",
       "w = vector rotate(P, 0.5, point (1, 2, 3), point (2, 3, 5));",
       [](float i) {
         return rsl::rotate(at(i), 0.5f, {1, 2, 3}, {2, 3, 5});
       },
       {.tolerance = 1e-5f}},
      {"faceforward turns what points along I",
       "w = faceforward(vector (0, 0, 1), vector (0, 0, 1), vector (0, 0, 1));", Vec3{0, 0, -1}},
      {"faceforward leaves what points against I",
       "w = faceforward(vector (0, 0, -1), vector (0, 0, 1), vector (0, 0, -1));", Vec3{0, 0, -1}},
      {"faceforward looks at Ng, not at what it turns", "w = faceforward(vector (1, 0, 1), vector (0, 0, 1));",
       Vec3{1, 0, 1}},
      {"faceforward of N", "w = faceforward(normalize(N), I);", Vec3{0, 0, -1}},
      {"reflect", "w = reflect(vector (1, -1, s), vector (0, 1, 0));",
       [](float i) {
         return Vec3{1, 1, i};
       }},
      {"refract without a change of medium", REFRACTED "w = refract(i, n, 1);", kDown},
      {"refract into glass", REFRACTED "w = refract(i, n, 1 / 1.5);", rsl::refract(kDown, {0, 1, 0}, 1 / 1.5f)},
      {"total reflection gives no direction", REFRACTED "w = refract(i, n, 1.5);", Vec3{0, 0, 0}},
      {"fresnel's shares", REFRACTED "float r, k; fresnel(i, n, 1 / 1.5, r, k); x = r * 10 + (r + k);",
       rsl::fresnel(kDown, {0, 1, 0}, 1 / 1.5f) * 10 + 1},
      {"fresnel's share at right angles",
       "float r, k; fresnel(vector (0, -1, 0), vector (0, 1, 0), 1 / 1.5, r, k); x = r;", 0.04f},
      {"fresnel's directions", REFRACTED "float r, k; vector a, b; fresnel(i, n, 1 / 1.5, r, k, a, b); w = a + b;",
       rsl::reflect(kDown, {0, 1, 0}) + rsl::refract(kDown, {0, 1, 0}, 1 / 1.5f)},
      {"transform into a space", "w = vector transform(\"world\", P);",
       [](float i) {
         return 2 * at(i) + Vec3{1, 2, 3};
       }},
      {"ptransform is another name of transform", "w = vector ptransform(\"world\", P);",
       [](float i) {
         return 2 * at(i) + Vec3{1, 2, 3};
       }},
      {"transform between spaces", "w = vector transform(\"object\", \"world\", P);",
       [](float i) {
         return 2 * at(i) + Vec3{1, 2, 3};
       }},
      {"vtransform leaves the translation out", "w = vtransform(\"world\", vector P);",
       [](float i) { return 2 * at(i); }},
      {"vtransform between spaces", "w = vtransform(\"object\", \"world\", vector P);",
       [](float i) { return 2 * at(i); }},
      {"ntransform", "w = ntransform(\"world\", normal (0, 0, s));",
       [](float i) {
         return Vec3{0, 0, 2 * i};
       }},
      {"transform by a matrix", "matrix m = translate((matrix 1), vector (1, 2, 3)); w = vector transform(m, P);",
       [](float i) {
         return at(i) + Vec3{1, 2, 3};
       }},
      {"vtransform by a matrix", "matrix m = translate((matrix 2), vector (1, 2, 3)); w = vtransform(m, vector P);",
       [](float i) { return 2 * at(i); }},
      {"ntransform by a matrix", "matrix m = scale((matrix 1), point (2, 1, 1)); w = ntransform(m, normal (s, 1, 0));",
       [](float i) {
         return Vec3{i / 2, 1, 0};
       }},
      {"depth is 0 at the near plane and 1 at the far one",
       "x = depth(point (0, 0, 1)) + 10 * depth(point (0, 0, 100)) + depth(P) * 0;", 10},
      {"depth in between", "x = depth(P);", 2.0f / 99},
      {"globals", "x = zcomp(N) + zcomp(Ng) + zcomp(I) + du + dv + v + xcomp(E);", -0.75f},
      {"time", "x = time + 10 * dtime;", 5.25f},
      {"ncomps", "x = ncomps;", 3},
      {"u", "x = floor(u);", 0},
      {"Cs and Os", "c = Cs * Os;", Vec3{0.25f, 0.25f, 0.25f}},
      {"dPdu and dPdv", "w = dPdu + dPdv;", Vec3{4, 4, 0}},
  };
  return kCases;
}

}  // namespace tomales::compiler
