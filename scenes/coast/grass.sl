#include "coast.h"

/* A dry blade of grass is darker at its root and pale at its tip. It is bright where the sun shines through it. */
surface grass(color root = color(0.13, 0.085, 0.03), tip = color(0.72, 0.54, 0.24)) {
  point q = transform("coast", P);
  float tone = 0.75 + 0.5 * float noise(q * 0.45) + 0.25 * (float cellnoise(q * 7) - 0.5);
  color blade = mix(root, tip, smoothstep(0, 0.8, v)) * tone;
  blade = mix(blade, blade * color(0.62, 0.85, 0.45), smoothstep(0.5, 0.75, float noise(q * 0.22 + vector(5, 5, 5))));
  color sun = 0;
  illuminance (P, vector(0, 1, 0), PI) {
    vector L1 = normalize(L), along = normalize(dPdv);
    float sine = sqrt(max(0, 1 - (L1 . along) * (L1 . along)));
    sun += Cl * (0.45 * sine + 0.25 * pow(max(0, L1 . normalize(I)), 2));
  }
  float open = smoothstep(-0.1, 0.6, v);
  Oi = Os;
  Ci = Os * blade * (sun * mix(0.25, 1, open) + mix(0.3, 1, open) * skylight(normal(0, 1, 0)));
}
