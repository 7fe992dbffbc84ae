#include "studio.h"

/* udn varies the raw clay below. union joins two sizes of iron specks in the glaze that has run down from above. */
surface stoneware(color clay = color(0.34, 0.20, 0.13), glaze = color(0.70, 0.66, 0.57), iron = color(0.13, 0.07, 0.04)) {
  point q = potpoint();
  float width = filterwidthp(q);
  float edge = 0.85 + 0.5 * snoise(0.9 * q) + 0.12 * snoise(4 * q);
  float covered = smoothstep(-0.02, 0.03, zcomp(q) - edge), rim = 1 - smoothstep(0, 0.12, abs(zcomp(q) - edge));
  float specks = union(smoothstep(0.72, 0.8, float noise(11 * q)), smoothstep(0.75, 0.82, float noise(23 * q))) * noisefade(11 * width);
  color paint = blend(clay * udn(6 * q, 0.8, 1.2), blend(glaze, iron, 0.85 * specks), covered);
  paint = blend(paint, iron, 0.5 * rim * covered);
  Oi = Os;
  Ci = Os * glazed(paint, faceforward(normalize(N), I), covered, 0.06);
}
