#include "noises.h"

/* Blocks of dressed stone lie in courses with joints. Each block has a tone of its own, and weathering has left clouds
 * in it.
 */
surface stone(color pale = color(0.54, 0.48, 0.40); float courses = 2.4, blocks = 1.1;) {
  point q = transform("hall", P);
  float width = filterwidthp(q);
  normal Nf = faceforward(normalize(N), I);
  normal n = normalize(ntransform("hall", Nf));
  float clouds = fBm(q / 2.2, width / 2.2, 5, 2.1, 0.55), grain = fBm(q * 9, 9 * width, 3, 2, 0.6);
  color paint = pale * (1 + 0.22 * clouds + 0.12 * grain);
  if (courses > 0) {
    float along = abs(xcomp(n)) > abs(zcomp(n)) ? zcomp(q) : xcomp(q);
    float row = floor(courses * ycomp(q)), y = mod(courses * ycomp(q), 1);
    float x = blocks * along + 0.5 * mod(row, 2) + 0.3 * float cellnoise(row);
    float tone = cellnoise(row, floor(x));
    float edge = min(min(y, 1 - y) / courses, min(mod(x, 1), 1 - mod(x, 1)) / blocks);
    float joint = 1 - smoothstep(0.006, 0.012 + width, edge);
    float upright = 1 - smoothstep(0.6, 0.8, abs(ycomp(n)));
    paint *= mix(1, (0.88 + 0.24 * tone) * (1 - 0.3 * joint * (1 - smoothstep(0.02, 0.08, width))), upright);
  }
  /* The stone is dark from damp near the floor. */
  paint *= mix(0.72, 1, smoothstep(0, 1.5, ycomp(q) + 0.5 * clouds));
  Oi = Os;
  Ci = Os * paint * (diffuse(Nf) + ambient());
}
