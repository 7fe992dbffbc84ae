#include "room.h"

/* This is a book that is bound in cloth. It shows the weave of the cloth, and gilt lines across its back. */
surface cloth_bound(varying float up = 0.5; color gold = color(0.62, 0.42, 0.16);) {
  point q = transform("room", P);
  float width = filterwidthp(q);
  color name = color cellnoise(point(977 * comp(Cs, 0), 977 * comp(Cs, 1), 977 * comp(Cs, 2)));
  color cloth = Cs * (0.85 + 0.3 * float noise(23 * q)) * (1 + 0.12 * fBm(900 * q, 900 * width, 1, 2, 0.5));
  float place = 0.10 + 0.10 * comp(name, 0);
  float lines = 0;
  if (comp(name, 1) > 0.35)
    lines = filterstep(place - 0.012, up) - filterstep(place, up) + filterstep(1 - place, up) - filterstep(1.012 - place, up) +
            (filterstep(0.62, up) - filterstep(0.80, up)) * 0.55 * step(0.6, comp(name, 2));
  normal Nf = faceforward(normalize(N), I);
  lines *= step(0.6, abs(zcomp(ntransform("room", normalize(Ng)))));
  Oi = Os;
  Ci = Os * (mix(cloth, gold, 0.75 * clamp(lines, 0, 1)) * received(Nf) + 0.14 * gloss(Nf, 1.4, 0.35, 12));
}
