#include "room.h"

/* This is wood with satin paint over it. */
surface joinery(color paint = color(0.5, 0.48, 0.43)) {
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (paint * received(Nf) + 0.6 * gloss(Nf, 1.45, 0.2, 8));
}
