#include "noises.h"

/* The view from the window shows the last light over hills, and the lamps of a town. */
surface dusk() {
  point q = transform("room", P);
  float x = xcomp(q), y = ycomp(q);
  float up = clamp((y + 0.5) / 8, 0, 1);
  color sky = mix(color(0.42, 0.22, 0.13), color(0.10, 0.17, 0.33), smoothstep(0.0, 0.32, up));
  sky = mix(sky, color(0.028, 0.06, 0.17), smoothstep(0.25, 1, up));
  sky *= 1 + 0.12 * fBm(point(0.25 * x, 1.6 * y, 0), 0.05, 5, 2.1, 0.55);
  float far = 0.9 + 0.8 * snoise(0.16 * x + 3) + 0.25 * snoise(0.6 * x), near = -0.4 + 0.7 * snoise(0.25 * x + 9) + 0.2 * snoise(1.9 * x);
  sky = mix(sky, color(0.030, 0.045, 0.085), 1 - smoothstep(-0.04, 0.04, y - far));
  sky = mix(sky, color(0.010, 0.014, 0.022), 1 - smoothstep(-0.04, 0.04, y - near));
  float a = 2.6 * x, b = 4.2 * y, name = cellnoise(a, b);
  float away = sqrt((mod(a, 1) - 0.5) * (mod(a, 1) - 0.5) + (mod(b, 1) - 0.5) * (mod(b, 1) - 0.5));
  float town = step(0.72, name) * (1 - smoothstep(0.08, 0.16, away)) * (1 - smoothstep(-0.6, 0.5, y - near)) ;
  Oi = 1;
  Ci = sky + town * mix(color(1.2, 0.62, 0.2), color(0.9, 0.85, 0.7), cellnoise(a + 77, b));
}
