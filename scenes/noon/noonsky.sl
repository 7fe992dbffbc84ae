#include "noon.h"

/* The sky has its own colour and a layer of fair-weather clouds, which are brighter on the side of the sun. */
surface noonsky(float cover = 0.28; vector drift = vector(4, 8, 3)) {
  vector d = normalize(vtransform("city", I));
  color sky = skycolor(d);
  /* Clouds are wider than they are high. */
  point q = point(3.2 * xcomp(d), 5.6 * ycomp(d), 3.2 * zcomp(d)) + drift;
  float width = isindirectray() > 0 ? 0.3 : filterwidthp(q);
  q += 0.12 * vsnoise(2.3 * q);
  float heap = fBm(q, width, 8, 2.1, 0.5);
  float sunward = fBm(q + 0.16 * SUN, width, 8, 2.1, 0.5);
  float thick = smoothstep(0.30 - cover, 0.52 - cover, heap) * smoothstep(0.01, 0.12, ycomp(d));
  color cloud = mix(color(0.58, 0.63, 0.71), color(0.98, 0.965, 0.94), clamp(0.55 + 1.6 * (heap - sunward), 0, 1));
  Oi = 1;
  Ci = mix(sky, cloud, 0.92 * thick);
}
