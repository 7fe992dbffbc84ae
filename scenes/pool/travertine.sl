#include "pool.h"

/* Slabs of travertine have layers and small holes along them. The joints are darker. */
surface travertine(color pale = color(0.66, 0.58, 0.46), dark = color(0.50, 0.40, 0.29); float slab = 0.62;) {
  point q = transform("court", P);
  float a, b;
  onplane(a, b);
  float width = filterwidthp(q);
  float number = cellnoise(a / slab, b / slab);
  point g = point(1.3 * a + 17 * number, 3.1 * number, 7 * b + 0.3 * snoise(2.3 * q));
  float layers = fBm(g, 7 * width, 5, 2.1, 0.55), clouds = fBm(1.7 * q, 1.7 * width, 4, 2, 0.5);
  color stone = mix(dark, pale, clamp(0.62 + 0.45 * layers + 0.25 * clouds + 0.35 * (number - 0.5), 0, 1));
  float holes = smoothstep(0.64, 0.8, float noise(point(14 * a, number, 60 * b))) * noisefade(50 * width);
  stone *= 1 - 0.45 * holes;
  float edge = slab * min(min(mod(a / slab, 1), 1 - mod(a / slab, 1)), min(mod(b / slab, 1), 1 - mod(b / slab, 1)));
  float line = (1 - smoothstep(0.003, 0.005 + width, edge)) * (1 - smoothstep(0.015, 0.05, width));
  stone *= 1 - 0.5 * line;
  normal Nf = faceforward(normalize(calculatenormal(P - 0.0015 * (holes + line) * normalize(N))), I);
  Oi = Os;
  Ci = Os * (stone * received(Nf) + 0.45 * (1 - holes) * (1 - line) * gloss(Nf, 1.4, 0.16, 12));
}
