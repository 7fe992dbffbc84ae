#include "room.h"

/* A small globe has brown seas, ochre land, and meridians. */
surface globe() {
  point q = transform("shader", P);
  float land = smoothstep(0.05, 0.13, fBm(13 * q, 13 * filterwidthp(q), 6, 2.1, 0.55));
  float lines = 1 - min(smoothstep(0, 0.03, abs(mod(24 * u, 1) - 0.5)), smoothstep(0, 0.03, abs(mod(12 * v, 1) - 0.5)));
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (mix(color(0.10, 0.16, 0.16), color(0.45, 0.30, 0.13), land) * (1 - 0.4 * lines) * received(Nf) + gloss(Nf, 1.45, 0.08, 6));
}
