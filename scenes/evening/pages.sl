#include "room.h"

/* These are the cut edges of a book's pages. */
surface pages(color paper = color(0.60, 0.52, 0.38)) {
  point q = transform("shader", P);
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * paper * (0.8 + 0.4 * float noise(1500 * ycomp(q))) * received(Nf);
}
