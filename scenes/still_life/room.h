/* The shaders of this scene share these functions for reflections of the room and for the light at a matte point. */
#ifndef ROOM_H
#define ROOM_H

#include "noises.h"

/* Returns what a glossy surface mirrors along R. Points that the eye sees take many rays in a cone, and points that are
 * seen in a mirror take one. Further points take a mean of the room instead, because rays would multiply otherwise.
 */
color mirror(point from; vector R; float cone, samples) {
  color seen = color(0.055, 0.05, 0.045);
  if (raydepth() == 0)
    seen = trace(from, normalize(R), "samplecone", cone, "samples", samples);
  else if (raydepth() == 1)
    seen = trace(from, normalize(R));
  return seen;
}

/* Returns the light at a matte point. It is the light of the lamps, and the light that the room sends back where
 * nothing covers the point. The latter is cooler and paler from above than from the table below. Points that the eye
 * sees compute how much is covered, and points in mirrors take a mean.
 */
color received(normal Nf) {
  float up = 0.5 + 0.5 * ycomp(normalize(ntransform("room", Nf)));
  color room = mix(color(0.13, 0.092, 0.058), color(0.10, 0.105, 0.112), up);
  float open = 0.6;
  if (raydepth() == 0) open = 1 - occlusion(P, Nf, 64, "maxdist", 7);
  return diffuse(Nf) + open * room;
}

/* Returns the share of light that a polished surface of index eta reflects towards the eye. */
float polish(vector In; normal Nf; float eta) {
  float Kr, Kt;
  fresnel(In, Nf, 1 / eta, Kr, Kt);
  return Kr;
}

#endif
