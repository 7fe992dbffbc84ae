#include "studio.h"

/* voronoi_f1f2_3d draws the cracks of a celadon glaze, which have ink in them. */
surface crackle(color celadon = color(0.40, 0.53, 0.44), ink = color(0.10, 0.085, 0.06)) {
  point q = potpoint();
  float f1 = 0, f2 = 0;
  point p1 = 0, p2 = 0;
  point bent = 1.9 * q + 0.35 * vsnoise(1.3 * q);
  voronoi_f1f2_3d(bent, 1, f1, p1, f2, p2);
  float far = (f2 - f1) * distance(p1, p2) / max(0.001, f1 + f2);
  float crack = 1 - smoothstep(0.012, 0.03 + filterwidthp(bent), far);
  color paint = mix(celadon * (0.9 + 0.16 * float cellnoise(p1)) * (1 + 0.06 * snoise(q)), ink, 0.8 * crack);
  Oi = Os;
  Ci = Os * glazed(paint, faceforward(normalize(N), I), 1, 0.02);
}
