#include "room.h"

/* The curtains are linen, and a little of the dusk shines through them. */
surface linen(color cloth = color(0.52, 0.46, 0.36)) {
  point q = transform("room", P);
  float width = filterwidthp(q);
  float threads = float noise(700 * xcomp(q), 40 * ycomp(q)) + float noise(40 * xcomp(q), 500 * ycomp(q)) - 1;
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * cloth * (1 + 0.25 * threads * noisefade(300 * width)) * (0.8 * received(Nf) + 0.2 * received(-Nf));
}
