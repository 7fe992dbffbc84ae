#include "pool.h"

/* These are painted or oiled boards, which stand upright and have dark joints. */
surface shutter(color paint = color(0.03, 0.07, 0.24); float slat = 0.16;) {
  point q = transform("court", P);
  float x = xcomp(q) / slat, width = filterwidthp(q);
  float edge = slat * min(mod(x, 1), 1 - mod(x, 1));
  float grain = fBm(point(40 * xcomp(q), 2 * ycomp(q), 2 * zcomp(q)), 40 * width, 3, 2.1, 0.5);
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (paint * (1 + 0.25 * grain) * (0.8 + 0.4 * cellnoise(x)) * mix(0.25, 1, smoothstep(0.002, 0.006 + width, edge)) * received(Nf) +
             0.6 * gloss(Nf, 1.45, 0.2, 8));
}
