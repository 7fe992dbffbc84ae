#include "pool.h"

/* A leaf or a bract lets a little light through from its other side. */
surface leaf(color green = color(0.14, 0.24, 0.15)) {
  point q = transform("court", P);
  normal Nf = faceforward(normalize(N), I);
  float tone = 0.75 + 0.5 * float noise(5 * q);
  Oi = Os;
  Ci = Os * green * tone * (0.75 * received(Nf) + 0.3 * diffuse(-Nf)) + 0.35 * Os * gloss(Nf, 1.4, 0.3, 4);
}
