#include "noon.h"

/* This shader draws the walls of houses. `bond` is 0 for stucco, 1 for brick, 2 for ashlar with open joints, and 3 for
 * the dressed stone of ledges and frames.
 */
surface masonry(float bond = 0) {
  point q = transform("city", P);
  normal Nf = faceforward(normalize(N), I), n = normalize(ntransform("city", Nf));
  color tint = Cs;
  if (isindirectray() == 0) {
    float along = abs(xcomp(n)) > 0.5 ? zcomp(q) : xcomp(q), y = ycomp(q), soft = max(filterwidthp(q), 0.0005);
    float stain = fBm(point(1.1 * along, 0.28 * y, xcomp(q)), soft, 5, 2.1, 0.55);
    float fine = fBm(9 * q, 9 * soft, 3, 2, 0.6);
    tint *= 1 + 0.16 * stain + 0.08 * fine;
    /* Rain washes soot down from the ledges. */
    float run = smoothstep(0.1, 0.7, fBm(point(5 * along, 0.16 * y, 3), 5 * soft, 3, 2, 0.5));
    tint *= mix(color(1, 1, 1), color(0.80, 0.78, 0.76), 0.6 * run);
    float fade = 1 - smoothstep(0.006, 0.03, soft);
    if (bond == 1) {
      float row = y / 0.075, shifted = along / 0.235 + 0.5 * mod(floor(row), 2);
      float joint = max(stroke(mod(row, 1), 0.5, 0.16, soft / 0.075), stroke(mod(shifted, 1), 0.5, 0.055, soft / 0.235));
      tint *= 1 + fade * 0.5 * (float cellnoise(floor(shifted - 0.5), floor(row - 0.5)) - 0.5);
      tint = mix(tint, color(0.52, 0.49, 0.45), 0.7 * joint * (1 - smoothstep(0.02, 0.06, soft)));
    } else if (bond == 2) {
      float row = y / 0.42, shifted = along / 0.95 + 0.5 * mod(floor(row), 2);
      float joint = max(stroke(mod(row, 1), 0.5, 0.07, soft / 0.42), stroke(mod(shifted, 1), 0.5, 0.024, soft / 0.95));
      tint *= 1 + 0.14 * (float cellnoise(floor(shifted - 0.5), floor(row - 0.5)) - 0.5);
      tint *= 1 - 0.55 * joint * (1 - smoothstep(0.04, 0.15, soft));
    } else if (bond == 3) {
      /* A chisel has left fine upright furrows. No two pieces of stone have quite the same tone. */
      tint *= 1 + 0.10 * (float noise(90 * along, 6 * y) - 0.5) * (1 - smoothstep(0.004, 0.015, soft));
      tint *= 1 + 0.12 * (float cellnoise(floor(along / 0.8), floor(y / 0.6)) - 0.5) * (1 - smoothstep(0.1, 0.3, soft));
    }
    /* Dirt splashes onto the foot of a wall and settles on the tops of ledges. */
    tint *= mix(0.78, 1, smoothstep(0, 0.9, y + 0.3 * stain));
    tint *= mix(1, 0.8, smoothstep(0.5, 0.95, ycomp(n)) * (0.6 + 0.4 * stain));
  }
  Oi = Os;
  Ci = Os * tint * received(Nf, isindirectray() + raydepth());
}
