/* The shaders of this scene share these functions for the light at a matte point and for reflections in a polished
 * surface.
 */
#ifndef ROOM_H
#define ROOM_H

#include "noises.h"

/* Returns the light at a matte point: that of the lamps and the dusk, and a little that comes from everywhere. */
color received(normal Nf) {
  return diffuse(Nf) + color(0.006, 0.005, 0.005);
}

/* Returns what a polished surface reflects by Fresnel's equations, averaged over a cone around the mirrored direction.
 * Points that are seen in a mirror take one ray, and further points take a mean of the room, because rays would
 * multiply otherwise.
 */
color gloss(normal Nf; float eta, cone, samples) {
  float Kr, Kt;
  vector In = normalize(I);
  color seen = color(0.05, 0.035, 0.02);
  fresnel(In, Nf, 1 / eta, Kr, Kt);
  if (raydepth() == 0)
    seen = trace(P, normalize(reflect(In, Nf)), "samplecone", cone, "samples", samples);
  else if (raydepth() == 1 && isindirectray() == 0)
    seen = trace(P, normalize(reflect(In, Nf)));
  return Kr * seen;
}

#endif
