#include "pool.h"

/* Painted plaster shows broad strokes of the brush, and pale clouds where rain has washed it. `photons` names a photon
 * map of the sunlight that the water throws on the wall.
 */
surface stucco(color paint = color(0.8, 0.77, 0.7); string photons = "";) {
  point q = transform("court", P);
  float width = filterwidthp(q);
  float clouds = fBm(0.9 * q, 0.9 * width, 5, 2.1, 0.55);
  float strokes = fBm(point(5 * xcomp(q), 11 * ycomp(q), 5 * zcomp(q)), 11 * width, 4, 2.1, 0.6);
  normal Nf = faceforward(normalize(calculatenormal(P + 0.0022 * strokes * normalize(N))), I);
  color light = received(Nf);
  if (photons != "") light += caustics(photons, Nf);
  Oi = Os;
  Ci = Os * paint * (1 + 0.16 * clouds + 0.06 * strokes) * light;
}
