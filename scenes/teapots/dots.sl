#include "studio.h"

/* repeat, whichtile and topolar2d draw dots. Every other row is moved by half the distance between dots. */
surface dots(color ground = color(0.56, 0.30, 0.27), dot = color(0.80, 0.75, 0.68)) {
  point q = potpoint();
  float row = whichtile(zcomp(q), 2.4), y = repeat(zcomp(q), 2.4), x = mod(18 * turns(q) + (odd(row) ? 0.5 : 0), 1);
  float r = 0, angle = 0;
  topolar2d(x, y, r, angle);
  float fuzz = 2 * min(0.3, filterwidth(2.4 * zcomp(q)));
  Oi = Os;
  Ci = Os * glazed(blend(ground, dot, 1 - smoothstep(0.5 - fuzz, 0.5 + fuzz, r)), faceforward(normalize(N), I), 1, 0.03);
}
