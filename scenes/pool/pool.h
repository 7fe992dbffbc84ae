/* What the shaders of this scene share: the sky, the light at a matte point, and what a polished one mirrors. Places are
 * in the coordinate system "court": metres, y up from the still water.
 */
#ifndef POOL_H
#define POOL_H

#include "noises.h"

#define SUN normalize(vector(-0.62, 0.66, -0.50))

/* Two coordinates in metres on a wall or floor, whichever way it faces. */
void onplane(output float a, b;) {
  point q = transform("court", P);
  normal n = ntransform("court", normalize(Ng));
  float x = abs(xcomp(n)), y = abs(ycomp(n)), z = abs(zcomp(n));
  a = (x > y && x > z) ? zcomp(q) : xcomp(q);
  b = (y > x && y > z) ? zcomp(q) : ycomp(q);
}

/* The radiance of the sky: deep blue above, pale at the horizon and towards the sun. */
color skycolor(vector direction) {
  vector d = normalize(direction);
  float near = pow(0.5 + 0.5 * (d . SUN), 3), up = max(ycomp(d), 0);
  color horizon = mix(color(0.52, 0.62, 0.72), color(0.95, 0.90, 0.80), near);
  color above = mix(color(0.07, 0.18, 0.43), color(0.30, 0.42, 0.60), near);
  return mix(horizon, above, pow(min(1, 1.6 * up), 0.6));
}

/* What comes to a matte point besides the sun, where nothing covers it: the sky from above, sunlit stone and water from below. */
color around(normal n) {
  float facing = 0.5 + 0.5 * ycomp(n);
  return mix(color(0.34, 0.30, 0.24), color(0.20, 0.28, 0.42), facing);
}

/* Sunlight that has come by the water: E/pi, from the photons that were stored before this frame. Photons ask shaders too,
 * as indirect rays do, and have no map yet.
 */
color caustics(string map; normal Nf) {
  color sum = 0;
  if (isindirectray() == 0) sum = photonmap(map, P, Nf, "estimator", 80, "maxdist", 0.15);
  return sum;
}

/* The light at a matte point. What one sees in a mirror or in the water does not ask how much is covered. */
color received(normal Nf) {
  normal n = normalize(ntransform("court", Nf));
  float open = 0.55;
  if (raydepth() == 0) open = 1 - occlusion(P, Nf, 96, "maxdist", 5);
  return diffuse(Nf) + open * around(n);
}

/* What a polished surface adds: Fresnel's share of what lies in the mirrored direction. */
color gloss(normal Nf; float eta, cone, samples) {
  float Kr, Kt;
  vector In = normalize(I);
  color seen = 0;
  fresnel(In, Nf, 1 / eta, Kr, Kt);
  if (raydepth() == 0) seen = trace(P, normalize(reflect(In, Nf)), "samplecone", cone, "samples", samples);
  return Kr * seen;
}

#endif
