#include "dandelion.h"

/* The sun shines through this blade of grass. Distant blades (far = 1) fade into the golden air, and near ones (far =
 * -1) are in shade.
 */
surface blade(float far = 0) {
  point q = transform("meadow", P);
  float tone = float noise(point(0.11 * xcomp(q), 0, 0.09 * zcomp(q)) + vector(7, 3, 1));
  color tint = mix(color(0.05, 0.115, 0.015), color(0.22, 0.25, 0.04), smoothstep(0.25, 0.75, tone + 0.3 * (v - 0.5)));
  tint *= 0.85 + 0.25 * abs(sin(9 * PI * u)) - 0.25 * (1 - smoothstep(0, 0.08, abs(u - 0.5)));
  vector along = normalize(dPdv), V = normalize(I);
  color light = 0;
  illuminance (P, vector(0, 0, 1), PI) {
    vector L1 = normalize(L);
    light += Cl * sqrt(max(0, 1 - (L1 . along) * (L1 . along))) * (0.3 + 0.75 * pow(max(0, L1 . V), 2));
  }
  float shade = (far < 0 ? 0.12 : 1) * mix(0.35, 1, smoothstep(-50, 10, ycomp(q)));
  Oi = Os;
  Ci = Os * tint * shade * (light + skylight(vector(0, 0.5, 0.5)));
  if (far > 0)
    Ci = mix(Ci, color(0.12, 0.12, 0.03), 0.6 * smoothstep(60, 420, zcomp(q)));
}
