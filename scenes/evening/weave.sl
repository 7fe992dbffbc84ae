#include "room.h"

/* The cushion is woven of thick yarn and has stripes. */
surface weave(color ground = color(0.40, 0.17, 0.055), stripe = color(0.58, 0.48, 0.32)) {
  point q = transform("shader", P);
  float width = filterwidthp(q), x = mod(xcomp(q) / 0.075, 1);
  float band = filterstep(0.62, x) - filterstep(0.72, x) + filterstep(0.8, x) - filterstep(0.9, x);
  float yarn = sin(PI * xcomp(q) / 0.004) * sin(PI * ycomp(q) / 0.004) * noisefade(width / 0.006);
  normal Nf = faceforward(normalize(calculatenormal(P + 0.0008 * (yarn + fBm(160 * q, 160 * width, 2, 2, 0.5)) * normalize(N))), I);
  Oi = Os;
  Ci = Os * mix(ground, stripe, band) * (1 + 0.2 * yarn) * received(Nf);
}
