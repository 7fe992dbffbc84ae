// Light (RISpec 3.2 sections 13.3 and 15.6). Light A lights all points, with L = (0, 0, -2) and Cl = (1, 2, 3); light B
// those of odd numbers, with L = (0, -3, 0) and Cl = 1/2.
#include <cmath>

#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
namespace {
float oddness(float i) { return std::fmod(i, 2.0f); }
}  // namespace

Cases lightCases() {
  static const Case kCases[] = {
      {"ambient", "c = ambient();",
       [](float i) {
         return Vec3{1, 2, i};
       }},
      {"diffuse", "c = diffuse(normalize(N));", Vec3{0, 0, -2}},
      {"specular", "c = specular(normalize(N), vector (s, 0, 0), 0.5);",
       [](float i) {
         return Vec3{i / 2, 0, -1};
       }},
      {"specularbrdf at its peak", "x = specularbrdf(vector (0, 0, 1), normal (0, 0, 1), vector (0, 0, 1), 0.1);", 1},
      {"specularbrdf beside it", "x = specularbrdf(vector (0, 1, 0), normal (0, 0, 1), vector (0, 0, 1), 8);",
       std::sqrt(0.5f)},
      {"phong", "c = phong(normalize(N), vector (0, 0, -1), 4);", Vec3{1, 2, 3}, {.tolerance = 1e-4f}},
      {"illuminance over the whole sphere", "illuminance (P) c += Cl;",
       [](float i) {
         return Vec3{1, 2, 3} + 0.5f * oddness(i) * Vec3{1, 1, 1};
       }},
      {"illuminance with an axis and an angle", "illuminance (P, N, PI / 2) c += Cl;",
       [](float i) {
         return Vec3{1, 2, 3} + 0.5f * oddness(i) * Vec3{1, 1, 1};
       }},
      {"illuminance of a category", "illuminance (\"key\", P, N, PI / 2) x += 1;",
       [](float i) { return 1 + oddness(i); }},
      {"illuminance of a category without an axis", "illuminance (\"key\", P) x += 1;",
       [](float i) { return 1 + oddness(i); }},
      {"illuminance with a list", "illuminance (P, N, PI / 2, \"lightcache\", \"refresh\") x += 1;",
       [](float i) { return 1 + oddness(i); }},
      {"L and Cl are the light's", "illuminance (P) w += L * comp(Cl, 0);",
       [](float i) {
         return Vec3{0, -1.5f * oddness(i), -2};
       }},
      {"diffuse light by hand", "normal n = normalize(N); illuminance (P, n, PI / 2) c += Cl * (normalize(L) . n);",
       Vec3{1, 2, 3}},
      {"lightsource", "illuminance (P) { float d = 0; if (lightsource(\"dimmed\", d) == 1) x += d; }",
       [](float i) { return 0.25f + 0.75f * oddness(i); }},
      {"lightsource of what there is not", "illuminance (P) { float d = 7; x += lightsource(\"other\", d) * 10 + d; }",
       [](float i) { return 7 + 7 * oddness(i); }},
      {"a list that asks for a light's value", "float d = 0; illuminance (P, \"light:dimmed\", d) x += d;",
       [](float i) { return 0.25f + 0.75f * oddness(i); }},
      {"break within illuminance", "illuminance (P) { x += 1; break; }", 1},
      {"break at some points", "illuminance (P) { x += 1; if (s > 4) break; }",
       [](float i) { return i > 4 ? 1 : 1 + oddness(i); }},
      {"continue within illuminance", "illuminance (P) { if (comp(Cl, 0) == 1) continue; x += 1; }", odd},
      {"break 2 out of a loop within illuminance",
       "float k; illuminance (P) { for (k = 0; k < 3; k += 1) { if (k == 1) break 2; x += 1; } }", 1},
      {"break out of an inner loop leaves illuminance alone",
       "float k; illuminance (P) { for (k = 0; k < 3; k += 1) { if (k == 1) break; x += 1; } }",
       [](float i) { return 1 + oddness(i); }},
      {"return within illuminance", "illuminance (P) { x += 1; if (s > 4) return; } x += 100;",
       [](float i) { return i > 4 ? 1 : 101 + oddness(i); }},
      {"return from a function within illuminance",
       "float f() { illuminance (P) { if (comp(Cl, 0) < 1) return 2; } return 3; } x = f();",
       [](float i) { return oddness(i) == 1 ? 2.0f : 3.0f; }},
      {"a branch around illuminance", "if (s > 4) illuminance (P) x += 1; else x = 7;",
       [](float i) { return i > 4 ? 1 + oddness(i) : 7; }},
      {"illuminance within a loop", "float k; for (k = 0; k < 2; k += 1) illuminance (P) x += 1;",
       [](float i) { return 2 + 2 * oddness(i); }},
      {"a loop that varies around illuminance", "float k; for (k = 0; k < mod(s, 3); k += 1) illuminance (P) x += 1;",
       [](float i) { return std::fmod(i, 3.0f) * (1 + oddness(i)); }},
      {"variables within illuminance start anew", "illuminance (P) { float a = 0; a += 1; x = a; }", 1},
      {"illuminance within illuminance",
       "illuminance (P) { float a = comp(Cl, 0); illuminance (P) x += a * comp(Cl, 0); }",
       [](float i) { return oddness(i) == 1 ? 2.25f : 1; }},
      {"an optional list of shadow", "c = shadow(\"a\", P, \"bias\", 0.25, \"blur\", 0.5);",
       [](float i) {
         return Vec3{i, 0.25f, 0.5f};
       }},
      {"a light with a place",
       "x = 1; illuminate (from) { Cl = 1; } w = L;",
       [](float i) {
         return Vec3{i - 1, 2 * i, 3};
       },
       {.parameters = "point from = (1, 0, 0);", .kind = "light"}},
      {"a light's cone",
       "illuminate (point (0, 0, 0), vector (0, 0, 1), PI / 4) x = 1;",
       [](float i) { return i * std::sqrt(5.0f) < 3 ? 1.0f : 0.0f; },
       {.kind = "light"}},
      {"an axis of a cone that is not of unit length",
       "illuminate (point (0, 0, 0), vector (0, 0, 5), PI / 4) x = 1;",
       [](float i) { return i * std::sqrt(5.0f) < 3 ? 1.0f : 0.0f; },
       {.kind = "light"}},
      {"outside of several cones there is some direction all the same",
       "illuminate (point (0, 0, 9), vector (0, 0, 1), PI / 4) x = 2;"
       "illuminate (point (0, 0, 8), vector (0, 0, 1), PI / 4) x = 3; w = L;",
       [](float i) {
         return Vec3{i, 2 * i, -6};
       },
       {.kind = "light"}},
      {"cones in a function",
       "float held = 0; void cone(point p; float n; output float h) { illuminate (p, vector (0, 0, 1), PI / 4) h = n; }"
       "cone(point (0, 0, 0), 1, held); cone(point (0, 0, 9), 2, held); if (held == 1) w = L;",
       [](float i) {
         return i * std::sqrt(5.0f) < 3 ? Vec3{i, 2 * i, 3} : Vec3{0, 0, 0};
       },
       {.kind = "light"}},
      {"of several cones, the one that holds the point gives the direction",
       "float held = 0; illuminate (point (0, 0, 0), vector (0, 0, 1), PI / 4) held = 1;"
       "illuminate (point (0, 0, 9), vector (0, 0, 1), PI / 4) held = 2; if (held == 1) w = L;",
       [](float i) {
         return i * std::sqrt(5.0f) < 3 ? Vec3{i, 2 * i, 3} : Vec3{0, 0, 0};
       },
       {.kind = "light"}},
      {"the inverse square",
       "illuminate (point (0, 0, 0)) c = 1 / (L . L);",
       [](float i) {
         const float y = 1 / (5 * i * i + 9);
         return Vec3{y, y, y};
       },
       {.kind = "light"}},
      {"a light from far away", "solar (vector (0, 0, 2), 0) x = 1; w = L;", Vec3{0, 0, 2}, {.kind = "light"}},
      {"a light from everywhere", "solar () x = 1;", 1, {.kind = "light"}},
      {"Ps is the point that is lit",
       "w = vector Ps;",
       [](float i) {
         return Vec3{i, 2 * i, 3};
       },
       {.kind = "light"}},
  };
  return kCases;
}

}  // namespace tomales::compiler
