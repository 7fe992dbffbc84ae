/* The shaders of this scene share the sky, the light at a matte point, and the reflections of polished surfaces. Points
 * are in the coordinate system "court". Its units are metres, and y points up from the still water.
 */
#ifndef POOL_H
#define POOL_H

#include "noises.h"

#define SUN normalize(vector(-0.62, 0.66, -0.50))

/* Sets a and b to two coordinates in metres on a wall or a floor, whichever way it faces. */
void onplane(output float a, b;) {
  point q = transform("court", P);
  normal n = ntransform("court", normalize(Ng));
  float x = abs(xcomp(n)), y = abs(ycomp(n)), z = abs(zcomp(n));
  a = (x > y && x > z) ? zcomp(q) : xcomp(q);
  b = (y > x && y > z) ? zcomp(q) : ycomp(q);
}

/* Returns the radiance of the sky. It is deep blue above, and pale at the horizon and towards the sun. */
color skycolor(vector direction) {
  vector d = normalize(direction);
  float near = pow(0.5 + 0.5 * (d . SUN), 3), up = max(ycomp(d), 0);
  color horizon = mix(color(0.52, 0.62, 0.72), color(0.95, 0.90, 0.80), near);
  color above = mix(color(0.07, 0.18, 0.43), color(0.30, 0.42, 0.60), near);
  return mix(horizon, above, pow(min(1, 1.6 * up), 0.6));
}

/* Returns the light besides the sun that an uncovered matte point receives. It comes from the sky above, and from
 * sunlit stone and water below.
 */
color around(normal n) {
  float facing = 0.5 + 0.5 * ycomp(n);
  return mix(color(0.34, 0.30, 0.24), color(0.20, 0.28, 0.42), facing);
}

/* Returns the sunlight that has come through the water, as irradiance divided by pi. It is estimated from the photons
 * that were stored before this frame. Shaders also run while photons are traced, as for indirect rays. The map does not
 * exist yet then, so the result is 0.
 */
color caustics(string map; normal Nf) {
  color sum = 0;
  if (isindirectray() == 0) sum = photonmap(map, P, Nf, "estimator", 80, "maxdist", 0.15);
  return sum;
}

/* Returns the light at a matte point. Points that are seen in a mirror or through the water take a mean occlusion,
 * because rays would multiply otherwise.
 */
color received(normal Nf) {
  normal n = normalize(ntransform("court", Nf));
  float open = 0.55;
  if (raydepth() == 0) open = 1 - occlusion(P, Nf, 96, "maxdist", 5);
  return diffuse(Nf) + open * around(n);
}

/* Returns what a polished surface reflects by Fresnel's equations. */
color gloss(normal Nf; float eta, cone, samples) {
  float Kr, Kt;
  vector In = normalize(I);
  color seen = 0;
  fresnel(In, Nf, 1 / eta, Kr, Kt);
  if (raydepth() == 0) seen = trace(P, normalize(reflect(In, Nf)), "samplecone", cone, "samples", samples);
  return Kr * seen;
}

#endif
