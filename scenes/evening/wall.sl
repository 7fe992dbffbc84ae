#include "room.h"

/* The plaster has a coat of limewash, and the brush has left clouds in it. */
surface wall(color paint = color(0.135, 0.20, 0.185)) {
  point q = transform("room", P);
  float width = filterwidthp(q);
  float clouds = fBm(1.6 * q, 1.6 * width, 6, 2.1, 0.55), brush = fBm(point(9 * xcomp(q), 5 * ycomp(q), 9 * zcomp(q)), 9 * width, 4, 2.1, 0.6);
  normal Nf = faceforward(normalize(calculatenormal(P + 0.0012 * brush * normalize(N))), I);
  Oi = Os;
  Ci = Os * paint * (1 + 0.2 * clouds + 0.08 * brush) * received(Nf);
}
