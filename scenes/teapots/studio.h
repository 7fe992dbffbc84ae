/* The twelve teapots share these functions for a point's place on the pot and for the way in which a fired glaze takes
 * the light of the studio.
 */
#ifndef STUDIO_H
#define STUDIO_H

#include "noises.h"
#include "patterns.h"
#include "rmannotes.h"

/* These return the point itself, and turns around the axis of the pot. Units are those of the teapot, which is 3.15
 * high.
 */
point potpoint() { return transform("object", P); }
float turns(point q) { return atan(ycomp(q), xcomp(q)) / (2 * PI) + 0.5; }

/* Returns what is seen of the studio along R. Points that the eye sees take rays in a cone, and points that are seen in
 * a mirror take a mean.
 */
color studio(point from; vector R; float cone) {
  color seen = color(0.22, 0.21, 0.20);
  if (raydepth() == 0 && isindirectray() == 0) seen = trace(from, normalize(R), "samplecone", cone, "samples", 4);
  return seen;
}

/* Returns the light of paint under a clear glaze of index 1.5. A gloss of 1 is the whole coat, and 0 is none. */
color glazed(color paint; normal Nf; float gloss, cone) {
  vector V = -normalize(I);
  float Kr, Kt;
  fresnel(-V, Nf, 1 / 1.5, Kr, Kt);
  color coat = 0;
  if (gloss > 0) coat = gloss * Kr * studio(P, reflect(-V, Nf), cone);
  return paint * (1 - gloss * Kr) * (diffuse(Nf) + ambient()) + coat;
}

#endif
