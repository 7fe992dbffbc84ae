#include "noon.h"

/* Polished metal, and by its colour lamps: it mirrors the street. glass: how much of it lies behind a lens with ribs. */
surface chrome(float glass = 0) {
  normal Nf = faceforward(normalize(N), I);
  color seen = skycolor(vtransform("city", reflect(normalize(I), Nf)));
  if (raydepth() == 0 && isindirectray() == 0) seen = trace(P, normalize(reflect(normalize(I), Nf)));
  color glint = 0;
  vector V = -normalize(I);
  illuminance ("sun", P, Nf, PI / 2) glint += Cl * pow(max(0, normalize(normalize(L) + V) . Nf), 400);
  Oi = Os;
  Ci = Cs * mix(0.75 * seen, 0.35 * seen + 0.5 * received(Nf, 1), glass) + mix(0, 0.06, glass) * seen + 1.2 * glint;
}
