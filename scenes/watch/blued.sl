#include "movement.h"

/* This steel has been heated until it is blue. */
surface blued(float bright = 1) {
  normal Nf = faceforward(normalize(N), I);
  color tint = mix(color(0.05, 0.13, 0.50), color(0.20, 0.09, 0.46), pow(1 - abs(normalize(I) . Nf), 2));
  Oi = Os;
  Ci = Os * bright * (polished(Nf, tint, 0.06, 32) + 0.01 * tint);
}
