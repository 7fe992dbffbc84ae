#include "room.h"

/* The peel is waxy, and greener at its ends. */
surface lemon(color ripe = color(0.88, 0.56, 0.035), unripe = color(0.58, 0.50, 0.05)) {
  point q = transform("shader", P);
  normal Nf = faceforward(normalize(N), I);
  float ends = smoothstep(0.42, 0.72, abs(ycomp(q))) + 0.35 * snoise(q * 2.5);
  color peel = mix(ripe, unripe, clamp(ends, 0, 0.85));
  vector V = -normalize(I);
  float Kr = polish(-V, Nf, 1.4);
  color mirrored = mirror(P, reflect(-V, Nf), 0.2, 12);
  Oi = Os;
  Ci = Os * (peel * received(Nf) + 0.8 * Kr * mirrored);
}
