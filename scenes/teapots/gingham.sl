#include "studio.h"

/* smoothpulsetrain draws gingham, which is two trains of stripes that cross. */
surface gingham(color cloth = color(0.74, 0.70, 0.64), red = color(0.45, 0.05, 0.045)) {
  point q = potpoint();
  float warp = smoothpulsetrain(0, 0.03, 0.5, 0.53, 1, 16 * turns(q)), weft = smoothpulsetrain(0, 0.03, 0.5, 0.53, 1, 2.1 * zcomp(q));
  Oi = Os;
  Ci = Os * glazed(mix(cloth, red, 0.5 * warp + 0.5 * weft), faceforward(normalize(N), I), 1, 0.03);
}
