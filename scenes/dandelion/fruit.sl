#include "dandelion.h"

/* A fruit is brown and has ribs. The same shader draws the pale bed on which the fruits stand, if pale is 1. */
surface fruit(float pale = 0) {
  normal Nf = faceforward(normalize(N), I);
  point q = transform("object", P);
  float pit = smoothstep(0.2, 0.5, snoise(2.2 * q));
  color tint = mix(color(0.17, 0.095, 0.045) * (0.7 + 0.5 * pow(abs(sin(5 * PI * u)), 2)), color(0.52, 0.48, 0.33) * (1 - 0.6 * pit), pale);
  Oi = Os;
  Ci = Os * tint * (diffuse(Nf) + skylight(ntransform("meadow", Nf)));
}
