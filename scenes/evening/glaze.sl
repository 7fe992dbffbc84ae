#include "room.h"

/* Stoneware has a clear glaze over it. */
surface glaze() {
  point q = transform("shader", P);
  float run = fBm(16 * q, 16 * filterwidthp(q), 4, 2.1, 0.55);
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (Cs * (1 + 0.35 * run) * received(Nf) + gloss(Nf, 1.5, 0.03, 8));
}
