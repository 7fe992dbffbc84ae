#include "room.h"

/* An old plastered wall shows the strokes of the trowel, and stains that years have left. */
surface plaster(color light = color(0.34, 0.31, 0.25), dark = color(0.20, 0.17, 0.13)) {
  point q = transform("room", P);
  float width = filterwidthp(q);
  float clouds = fBm(q / 4, width / 4, 6, 2.1, 0.55), strokes = fBm(point(xcomp(q), 2.2 * ycomp(q), 0) * 1.3, width * 2, 5, 2.2, 0.6);
  normal Nf = faceforward(normalize(calculatenormal(P + 0.035 * strokes * normalize(N))), I);
  Oi = Os;
  Ci = Os * mix(dark, light, smoothstep(-0.7, 0.6, clouds + 0.35 * strokes)) * received(Nf);
}
