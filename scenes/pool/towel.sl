#include "pool.h"

/* The towel is terry cloth with stripes. */
surface towel(color ground = color(0.80, 0.76, 0.68), stripe = color(0.07, 0.20, 0.42)) {
  point q = transform("shader", P);
  float x = mod(xcomp(q) / 0.12 + 0.5, 1), width = filterwidthp(q);
  float band = filterstep(0.3, x) - filterstep(0.7, x);
  float pile = fBm(220 * q, 220 * width, 2, 2, 0.5);
  normal Nf = faceforward(normalize(calculatenormal(P + 0.002 * pile * normalize(N))), I);
  Oi = Os;
  Ci = Os * mix(ground, stripe, band) * (1 + 0.25 * pile) * received(Nf);
}
