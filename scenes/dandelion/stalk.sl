#include "dandelion.h"

/* A hollow stalk is reddish below and green above. A little light shines through its rim. */
surface stalk() {
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  color tint = mix(color(0.22, 0.13, 0.07), color(0.24, 0.30, 0.08), v) * (1 + 0.15 * snoise(point(40 * u, 3 * v, 0)));
  color through = 0;
  illuminance (P, vector(0, 0, 1), PI)
    through += Cl * (0.10 + 0.55 * pow(1 - abs(Nf . V), 2)) * (0.6 + 0.4 * (normalize(L) . Nf));
  Oi = Os;
  Ci = Os * tint * (diffuse(Nf) + through + skylight(ntransform("meadow", Nf)));
}
