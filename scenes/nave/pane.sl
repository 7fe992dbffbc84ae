#include "filterwidth.h"

/* This is old glass in lead, with the sky behind it. Each small pane has a tint of its own. */
surface pane(color sky = color(1.9, 1.95, 2.0); float size = 0.34;) {
  point q = transform("hall", P);
  normal n = normalize(ntransform("hall", normalize(N)));
  float along = abs(xcomp(n)) > 0.5 ? zcomp(q) : xcomp(q);
  float x = (along + 0.7 * ycomp(q)) / size, y = (along - 0.7 * ycomp(q)) / size;
  float edge = min(min(mod(x, 1), 1 - mod(x, 1)), min(mod(y, 1), 1 - mod(y, 1)));
  float lead = 1 - smoothstep(0.05, 0.08, edge);
  color tint = mix(color(1, 0.86, 0.62), color(0.72, 0.88, 1), float cellnoise(floor(x), floor(y)));
  Oi = Os;
  Ci = Os * sky * tint * (1 - 0.9 * lead * (1 - smoothstep(0.1, 0.4, filterwidthp(q) / size)));
}
