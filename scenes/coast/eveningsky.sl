#include "coast.h"

/* The sky surrounds the scene. It has its own colour and thin clouds, which the low sun lights from below. */
surface eveningsky(float cover = 0.5) {
  vector d = normalize(vtransform("coast", I));
  color sky = skycolor(d);
  /* Clouds lie in a flat layer. The nearer a direction is to the horizon, the flatter it crosses this layer. */
  float up = max(ycomp(d), 0.015);
  point q = point(xcomp(d) / (up + 0.09), 0, zcomp(d) / (up + 0.09));
  q = point(0.55 * xcomp(q) + 0.25 * zcomp(q), 3.7, 1.3 * zcomp(q) - 0.3 * xcomp(q));
  q += 0.35 * vsnoise(1.2 * q);
  float width = filterwidthp(q);
  float veil = fBm(1.1 * q, 1.1 * width, 7, 2.05, 0.55);
  float streaks = fBm(point(2.2 * xcomp(q), 1, 9 * zcomp(q)), 9 * width, 5, 2.1, 0.55);
  float thick = smoothstep(0.25 - cover, 1.05, veil + 0.28 * streaks) * smoothstep(0.01, 0.09, ycomp(d));
  float near = 0.5 + 0.5 * (d . SUN);
  color lit = mix(color(0.78, 0.55, 0.52), color(1.5, 1.02, 0.62), pow(near, 1.5));
  Oi = 1;
  Ci = mix(sky, lit, 0.85 * thick);
}
