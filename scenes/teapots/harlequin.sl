#include "studio.h"

/* rotate2d, pulse, even and odd draw lozenges with lines between them. */
surface harlequin(color dark = color(0.055, 0.055, 0.06), ochre = color(0.60, 0.39, 0.10), line = color(0.78, 0.72, 0.60)) {
  point q = potpoint();
  float x = 0, y = 0;
  rotate2d(12 * turns(q), 1.2 * zcomp(q), PI / 4, 0, 0, x, y);
  x = 1.4142 * x;
  y = 1.4142 * y;
  float a = mod(x, 1), b = mod(y, 1);
  color paint = even(floor(x) + floor(y)) ? dark : ochre;
  float inside = intersection(pulse(0.05, 0.95, 0.03, a), pulse(0.05, 0.95, 0.03, b));
  Oi = Os;
  Ci = Os * glazed(blend(line, paint, inside), faceforward(normalize(N), I), 1, 0.03);
}
