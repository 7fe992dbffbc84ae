#include "studio.h"

/* voronoi_f1_3d draws chips of stone in cement, and varyEach gives each chip its own colour. */
surface terrazzo(color cement = color(0.62, 0.58, 0.53), chip = color(0.45, 0.20, 0.13)) {
  point q = potpoint();
  float f1 = 0, g1 = 0;
  point p1 = 0, p2 = 0;
  voronoi_f1_3d(3.1 * q + 0.25 * vsnoise(5 * q), 0.9, f1, p1);
  voronoi_f1_3d(7.0 * q + 0.25 * vsnoise(11 * q), 0.9, g1, p2);
  float large = 1 - smoothstep(0, 0.03, f1 - 0.17 - 0.30 * float cellnoise(p1));
  float small = 1 - smoothstep(0, 0.06, g1 - 0.10 - 0.24 * float cellnoise(p2));
  color paint = mix(cement, varyEach(chip, 91 * float cellnoise(p2 + vector(9, 9, 9)), 0.10, 0.5, 0.5), small);
  paint = mix(paint, varyEach(chip, 57 * float cellnoise(p1 + vector(4, 4, 4)), 0.12, 0.5, 0.55), large);
  Oi = Os;
  Ci = Os * glazed(paint, faceforward(normalize(N), I), 0.9, 0.05);
}
