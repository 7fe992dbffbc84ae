/* The shaders of this scene share the sun, the sky, and the reflections of polished surfaces. Points and directions are
 * in the coordinate system "city". Its units are metres, x points to the right, y up and z away from the eye.
 */
#ifndef NOON_H
#define NOON_H

#include "noises.h"

#define SUN normalize(vector(-0.44, 0.82, -0.36))

/* Returns the radiance of the sky without clouds. It is blue above, pale at the horizon, and white around the sun. */
color skycolor(vector direction) {
  vector d = normalize(direction);
  float up = max(ycomp(d), 0), near = max(0, d . SUN);
  color clear = mix(color(0.62, 0.70, 0.78), color(0.085, 0.21, 0.50), pow(min(1, 1.15 * up), 0.42));
  return clear + color(0.30, 0.28, 0.24) * pow(near, 8);
}

/* Returns the light that a matte surface receives from sky and houses, in the units of diffuse(). It stands in for
 * indirect light at points for which none is computed.
 */
color skylight(normal n) {
  float up = 0.5 + 0.5 * ycomp(n);
  return mix(color(0.16, 0.145, 0.125), color(0.25, 0.32, 0.42), up);
}

/* Returns the light at a matte point. At points that the eye sees, diffuse() brings the sun and the indirect light. At
 * points that rays meet, it brings the sun alone, and the formula adds the sky.
 */
color received(normal Nf; float raylevel) {
  return raylevel > 0 ? diffuse(Nf) + skylight(normalize(ntransform("city", Nf))) : diffuse(Nf);
}

/* Returns what a polished surface reflects by Fresnel's equations. Points that are seen in a mirror themselves reflect
 * only the sky, because rays would multiply otherwise.
 */
color mirrored(normal Nf; float eta, cone, samples) {
  float Kr, Kt;
  vector In = normalize(I), R = normalize(reflect(In, Nf));
  color seen = skycolor(vtransform("city", R));
  fresnel(In, Nf, 1 / eta, Kr, Kt);
  if (raydepth() == 0) seen = trace(P, R, "samplecone", cone, "samples", samples);
  return Kr * seen;
}

/* Returns 1 on a line of the given width around `middle`, and fades to 0 over a pixel. */
float stroke(float x, middle, width, soft) {
  return 1 - smoothstep(0.5 * width - 0.5 * soft, 0.5 * width + 0.5 * soft, abs(x - middle));
}

/* Returns 1 where x lies between `low` and `high`, and fades to 0 over a pixel. */
float between(float x, low, high, soft) {
  return smoothstep(low - 0.5 * soft, low + 0.5 * soft, x) * (1 - smoothstep(high - 0.5 * soft, high + 0.5 * soft, x));
}

#endif
