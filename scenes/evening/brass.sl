#include "room.h"

/* This brass has a soft shine and some tarnish. */
surface brass(color metal = color(0.80, 0.56, 0.25)) {
  point q = transform("room", P);
  float tarnish = smoothstep(-0.2, 0.6, fBm(14 * q, 14 * filterwidthp(q), 5, 2.1, 0.55));
  vector In = normalize(I);
  normal Nf = faceforward(normalize(N), In);
  color seen = color(0.05, 0.035, 0.02);
  if (raydepth() == 0)
    seen = trace(P, normalize(reflect(In, Nf)), "samplecone", 0.09, "samples", 16);
  else if (raydepth() == 1 && isindirectray() == 0)
    seen = trace(P, normalize(reflect(In, Nf)));
  Oi = Os;
  Ci = Os * (mix(metal * mix(1, 0.6, tarnish), color(1), pow(1 - abs(Nf . In), 5)) * seen + 0.12 * metal * received(Nf));
}
