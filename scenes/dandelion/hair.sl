#include "dandelion.h"

/* The sun shines through this hair. Like any thread, it is bright at its sides (J. Kajiya and T. Kay, 1989). It is
 * brightest when seen against the light.
 */
surface hair(color tint = color(0.92, 0.90, 0.86); float bristle = 0) {
  vector along = normalize(dPdv), V = normalize(I);
  color light = 0;
  illuminance (P, vector(0, 0, 1), PI) {
    vector L1 = normalize(L);
    float sine = sqrt(max(0, 1 - (L1 . along) * (L1 . along)));
    float against = max(0, L1 . V);
    light += Cl * (0.16 * sine + 0.55 * sine * pow(against, 3) + 0.9 * pow(sine, 12) * pow(against, 8));
  }
  color root = mix(color(1), color(0.35, 0.42, 0.12), bristle * (1 - smoothstep(0, 0.45, v)));
  /* Other hairs block the light deep in the head and on its side away from the sun. */
  point q = transform("meadow", P);
  vector out = (q - HEAD) / 23.5;
  float inside = 1 - smoothstep(1.02, 1.12, length(out));
  float open = mix(0.14, 1, smoothstep(0.3, 1.0, length(out))) * (0.65 + 0.45 * (out . SUN));
  Oi = Os;
  Ci = mix(1, open, inside) * Os * tint * root * (1.25 * light + 0.5 * skylight(vtransform("meadow", -V)));
}
