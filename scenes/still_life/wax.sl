#include "room.h"

/* This is candle wax. The flame fills it with light from above. */
surface wax(color wax = color(0.80, 0.72, 0.56), glow = color(1.0, 0.42, 0.11); float top = 3.25, reach = 0.45;) {
  point q = transform("shader", P);
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (wax * received(Nf) + 1.3 * glow * exp((ycomp(q) - top) / reach));
}
