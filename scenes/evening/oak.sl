#include "room.h"

/* This is dark oiled wood. Its grain runs along the length of the boards, which stand upright here and lie flat in
 * table tops.
 */
surface oak(color pale = color(0.26, 0.145, 0.07), dark = color(0.10, 0.046, 0.02)) {
  point q = transform("shader", P);
  float width = filterwidthp(q);
  point g = point(6 * xcomp(q), 6 * ycomp(q), 22 * zcomp(q));
  g += 0.25 * vsnoise(3 * q);
  float fibre = fBm(g, 22 * width, 5, 2.2, 0.6), year = 0.5 + 0.5 * sin(2 * PI * (9 * zcomp(q) + 2.4 * ycomp(q) + 0.8 * snoise(2.2 * q)));
  color wood = mix(pale, dark, clamp(0.3 + 0.35 * year + 0.5 * fibre, 0, 1));
  normal Nf = faceforward(normalize(calculatenormal(P - 0.0006 * fibre * normalize(N))), I);
  Oi = Os;
  Ci = Os * (wood * received(normalize(faceforward(N, I))) + 0.7 * gloss(Nf, 1.45, 0.14, 10));
}
