#include "studio.h"

/* tilepattern draws small tiles with grout, and varyEach makes each a little different. */
surface bricks(color tile = color(0.10, 0.27, 0.34), grout = color(0.58, 0.54, 0.47); float around = 22, rows = 3.6;) {
  point q = potpoint();
  float ss = around * turns(q), tt = rows * zcomp(q), ds = min(filterwidth(ss), 0.3), dt = filterwidth(tt);
  float column = 0, row = 0, x = 0, y = 0;
  float inside = tilepattern(ss, tt, ds, dt, 0.09, 0.09, column, row, x, y);
  color paint = mix(grout, varyEach(tile, mod(column, around) + 37 * row, 0.07, 0.3, 0.22), inside);
  Oi = Os;
  Ci = Os * glazed(paint, faceforward(normalize(N), I), inside, 0.03);
}
