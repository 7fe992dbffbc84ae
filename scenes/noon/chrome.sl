#include "noon.h"

/* Polished metal reflects the street. Coloured lamps use this shader too: `glass` is the share that lies behind a lens.
 */
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
