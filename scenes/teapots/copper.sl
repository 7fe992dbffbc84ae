#include "studio.h"

/* This is beaten copper, which is brown where it has been touched less. */
surface copper(color metal = color(0.93, 0.50, 0.32)) {
  point q = potpoint();
  normal Nf = faceforward(normalize(N), I);
  float brown = smoothstep(-0.2, 0.7, fBm(1.1 * q, 1.1 * filterwidthp(q), 5, 2.1, 0.55));
  color tint = metal * mix(color(1), color(0.55, 0.42, 0.36), brown);
  float grazing = pow(1 - abs(normalize(I) . Nf), 5);
  color seen = color(0.22, 0.21, 0.20);
  if (raydepth() == 0 && isindirectray() == 0)
    seen = trace(P, reflect(normalize(I), Nf), "samplecone", 0.1, "samples", 16);
  Oi = Os;
  Ci = Os * (mix(tint, color(1), grazing) * seen + 0.12 * metal * (diffuse(Nf) + ambient()));
}
