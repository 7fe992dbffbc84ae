#include "studio.h"

/* fBm draws the rings and pores of walnut. */
surface walnut(color pale = color(0.36, 0.20, 0.10), dark = color(0.11, 0.05, 0.025)) {
  point q = potpoint() + vector(1.1, 0.4, 0);
  float width = filterwidthp(q);
  float r = sqrt(xcomp(q) * xcomp(q) + 0.5 * zcomp(q) * zcomp(q)) + 0.30 * fBm(0.9 * q, 0.9 * width, 3, 2, 0.5);
  float ring = mod(4.2 * r, 1);
  float late = smoothstep(0.1, 0.85, ring) * (1 - smoothstep(0.9, 1, ring));
  float pores = smoothstep(0.62, 0.8, float noise(point(4 * ycomp(q), 30 * xcomp(q), 30 * zcomp(q)))) * noisefade(30 * width);
  color paint = mix(pale, dark, clamp(0.15 + 0.7 * late + 0.3 * fBm(point(3 * ycomp(q), 14 * xcomp(q), 14 * zcomp(q)), 14 * width, 3, 2, 0.5), 0, 1));
  Oi = Os;
  Ci = Os * glazed(paint * (1 - 0.5 * pores), faceforward(normalize(N), I), 0.6, 0.10);
}
