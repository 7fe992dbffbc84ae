/* What the twelve teapots share: where a point is on the pot, and how a fired glaze takes the light of the studio. */
#ifndef STUDIO_H
#define STUDIO_H

#include "noises.h"
#include "patterns.h"
#include "rmannotes.h"

/* Coordinates on the pot: turns around its axis, height over its foot, and the point itself. Units are those of the
 * teapot, which is 3.15 high.
 */
point potpoint() { return transform("object", P); }
float turns(point q) { return atan(ycomp(q), xcomp(q)) / (2 * PI) + 0.5; }

/* What the studio mirrors along R: the eye's points take rays in a cone, what is seen in a mirror takes a mean. */
color studio(point from; vector R; float cone) {
  color seen = color(0.22, 0.21, 0.20);
  if (raydepth() == 0 && isindirectray() == 0) seen = trace(from, normalize(R), "samplecone", cone, "samples", 4);
  return seen;
}

/* Paint under a clear glaze of index 1.5; gloss 1 has the whole coat, 0 none. */
color glazed(color paint; normal Nf; float gloss, cone) {
  vector V = -normalize(I);
  float Kr, Kt;
  fresnel(-V, Nf, 1 / 1.5, Kr, Kt);
  color coat = 0;
  if (gloss > 0) coat = gloss * Kr * studio(P, reflect(-V, Nf), cone);
  return paint * (1 - gloss * Kr) * (diffuse(Nf) + ambient()) + coat;
}

#endif
