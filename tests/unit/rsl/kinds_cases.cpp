// Displacements, volumes and imagers: what they may read and assign (RISpec 3.2 tables 12.1 to 12.5).
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {

Cases kindCases() {
  static const Case kCases[] = {
      {"a displacement moves P",
       "P += vector (1, 2, s); w = vector P;",
       [](float i) {
         return Vec3{i + 1, 2 * i + 2, 3 + i};
       },
       {.kind = "displacement"}},
      {"a displacement moves P at some points",
       "if (s > 2) P += vector (0, 0, 1); x = zcomp(P);",
       [](float i) { return i > 2 ? 4.0f : 3.0f; },
       {.kind = "displacement"}},
      {"a displacement sets a component of P",
       "setzcomp(P, s); w = vector P;",
       [](float i) {
         return Vec3{i, 2 * i, i};
       },
       {.kind = "displacement"}},
      {"a displacement sets N",
       "N = normal (s, 0, 1); w = N;",
       [](float i) {
         return Vec3{i, 0, 1};
       },
       {.kind = "displacement"}},
      {"a displacement asks for the normal of what it moved",
       "P += vector (0, 0, 1); w = calculatenormal(P);",
       [](float i) {
         return Vec3{-i, -2 * i, -4};
       },
       {.kind = "displacement"}},
      {"a volume fades", "Ci = mix(Ci, color (1, 1, 1), 0.5); c = Ci;", Vec3{-3, -3, -3}, {.kind = "volume"}},
      {"a volume knows how far it is", "x = length(I);", 1, {.kind = "volume"}},
      {"an imager sees alpha", "x = alpha;", 0.125f, {.kind = "imager"}},
      {"an imager changes Ci", "Ci += (1 - alpha) * color (8, 8, 8); c = Ci;", Vec3{0, 0, 0}, {.kind = "imager"}},
      {"an imager changes alpha", "alpha = 1; Oi = 1; x = alpha + comp(Oi, 0);", 2, {.kind = "imager"}},
      {"a surface's Ci", "Ci = s * Cs; Oi = Os; c = Ci;",
       [](float i) {
         return Vec3{i / 4, i / 2, i};
       }},
      {"a surface's Ci that is never assigned is Cs, and Oi starts as Os", "c = Ci * Oi;", Vec3{0.25f, 0.25f, 0.25f}},
      {"a surface's Ci that is assigned starts as black", "Ci += s * Cs; c = Ci;",
       [](float i) {
         return Vec3{i / 4, i / 2, i};
       }},
      {"a surface's Ci is black where no branch assigns it", "if (s > 2) Ci = 4 * Cs; c = Ci;",
       [](float i) {
         return i > 2 ? Vec3{1, 2, 4} : Vec3{0, 0, 0};
       }},
      {"a surface changes N for itself", "N = normal (0, 1, 0); w = N;", Vec3{0, 1, 0}},
      {"a light's Cl",
       "Cl = s * color (1, 2, 3); c = Cl;",
       [](float i) {
         return Vec3{i, 2 * i, 3 * i};
       },
       {.kind = "light"}},
  };
  return kCases;
}

}  // namespace tomales::compiler
