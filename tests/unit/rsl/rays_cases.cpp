// Rays, pictures and clouds of points.
#include <cmath>

#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
Cases rayCases() {
  static const Case kCases[] = {
      {"trace gives a color", "c = trace(P, vector (0, 0, 1));",
       [](float i) {
         return at(i) + Vec3{0, 0, 1};
       }},
      {"trace gives a distance", "x = trace(P, vector (0, 3, 4));", 5},
      {"trace with a list", "c = trace(P, vector (0, 0, 1), \"samples\", 4, \"label\", \"a\");",
       [](float i) {
         return at(i) + Vec3{0, 0, 1};
       }},
      {"transmission", "c = transmission(P, point (s, 1, 2));",
       [](float i) {
         return Vec3{0, 1 - 2 * i, -1};
       }},
      {"visibility", "c = visibility(P, point (s, 1, 2));",
       [](float i) {
         return Vec3{0, 1 - 2 * i, -1};
       }},
      {"fulltrace",
       "color c = 0; float d = 0; point p = 0, q = 0; vector n = 0, r = 0; x = fulltrace(P, N, c, d, p, n, q, r) == d;",
       1},
      {"rayhittest", "point p = 0; vector n = 0; x = rayhittest(P, N, p, n) > -1;", 1},
      {"rayserver, whose points and directions are in world space",
       "c = rayserver(transform(\"world\", P), vtransform(\"world\", vector (0, 0, 1)));",
       [](float i) {
         return 2 * at(i) + Vec3{1, 2, 3} + Vec3{0, 0, 2};
       }},
      {"occlusion", "x = occlusion(P, normalize(N), 16);", 0.5f},
      {"occlusion without a number of samples", "x = occlusion(P, normalize(N));", 0.5f},
      {"occlusion with a list", "x = occlusion(P, normalize(N), 16, \"maxdist\", 5);", 0.5f},
      {"occlusion fills", "vector d = (0, 0, 0); x = occlusion(P, N, 16, \"environmentdir\", d); x += ycomp(d);", 1.5f},
      {"indirectdiffuse", "c = indirectdiffuse(P, N, 16);", Vec3{0, 0, -1}},
      {"indirect", "c = indirect(P, N, 16);", Vec3{0, 0, -1}},
      {"photonmap", "c = photonmap(\"a.pmap\", P, N, \"estimator\", 20);", Vec3{20, tmPhotonDefaults().maxDistance, 0}},
      {"caustic", "c = caustic(P, N); x = 1;", 1},
      {"subsurface", "c = subsurface(P, N, \"filename\", \"a\"); x = 1;", 1},
      {"bake3d changes nothing", "x = bake3d(\"a.ptc\", \"v\", P, N, \"v\", s);", 1},
      {"texture3d", "float f = 1; x = texture3d(\"a.ptc\", P, N, \"v\", f); x += f;",
       [](float i) { return std::fmod(i, 2.0f) == 0 ? 6.0f : 1.0f; }},
      {"gather's rays", "float n = 0, m = 0; gather(\"\", P, N, 0.5, 4) { n += 1; } else { m += 1; } x = n * 10 + m;",
       22},
      {"gather fills", "float d = 0; gather(\"illuminance\", P, N, 0.5, 2, \"ray:length\", d) { x += d; }",
       [](float i) { return std::fmod(i, 2.0f) == 0 ? i : 10 + i; }},
      {"break within gather", "gather(\"\", P, N, 0.5, 4) { x += 1; break; }", 1},
      {"texture with s and t of the surface", "c = color texture(\"a\");",
       [](float i) {
         return Vec3{i, -i, 0};
       }},
      {"texture over four corners", "x = texture(\"a\", 0, 0, 1, 0, 0, 1, 1, 1);", 0.5f},
      {"texture with a list", "x = texture(\"a\", s, t, \"blur\", 0.5, \"filter\", \"box\");",
       [](float i) { return i; }},
      {"texture's name is computed", "x = texture(concat(\"a\", \"b\"), s, t);", [](float i) { return i; }},
      {"texture in a branch", "if (s > 2) x = texture(\"a\", s, t);", [](float i) { return i > 2 ? i : 0; }},
      {"environment over four corners",
       "c = environment(\"a\", vector (0, 0, 1), vector (0, 0, 1), vector (0, 0, 1), vector (0, 0, 1));",
       Vec3{0, 0, 1}},
      {"textureinfo", "float r[2]; x = textureinfo(\"a\", \"resolution\", r); x += r[0] + r[1];", 1121},
      {"textureinfo of what there is not", "float r = 3; x = textureinfo(\"a\", \"other\", r) * 10 + r;", 3},
  };
  return kCases;
}

}  // namespace tomales::compiler
