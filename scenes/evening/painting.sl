#include "room.h"

/* This is a landscape in oil. It shows a lake between hills, painted with a broad brush. */
surface painting() {
  point q = point(3 * s, 2 * t, 0.3);
  vector bend = 0.05 * vsnoise(9 * q);
  float x = 3 * s + xcomp(bend), y = 1 - t + 0.7 * ycomp(bend);
  color paint = mix(color(0.62, 0.42, 0.22), color(0.16, 0.26, 0.33), smoothstep(0.5, 0.95, y + 0.15 * snoise(point(1.5 * x, 5 * y, 0))));
  paint = mix(paint, color(0.10, 0.15, 0.17), 1 - smoothstep(-0.01, 0.02, y - 0.58 - 0.1 * snoise(1.9 * x)));
  paint = mix(paint, mix(color(0.30, 0.27, 0.20), color(0.09, 0.15, 0.18), float noise(point(2 * x, 30 * y, 1))), 1 - smoothstep(-0.01, 0.02, y - 0.40));
  paint = mix(paint, color(0.075, 0.07, 0.028) * (0.6 + float noise(point(14 * x, 25 * y, 2))), 1 - smoothstep(-0.01, 0.02, y - 0.17 - 0.1 * snoise(1.3 * x + 4)));
  float brush = fBm(point(60 * s + 4 * snoise(6 * q), 90 * t, 0), 0, 3, 2, 0.6);
  normal Nf = faceforward(normalize(calculatenormal(P + 0.002 * brush * normalize(N))), I);
  Oi = Os;
  Ci = Os * (paint * (1 + 0.25 * brush) * received(Nf) + 0.5 * gloss(Nf, 1.45, 0.15, 6));
}
