#include "noises.h"

/* The cloth of a lampshade is brightest at the height of the bulb behind it, and its threads cross. This shader gives
 * only the view of the shade. An area light sends the light of the shade into the room.
 */
surface lampshade(float height = 0.27; color warm = color(0.55, 0.24, 0.075), hot = color(1.3, 0.80, 0.38);) {
  point q = transform("shader", P);
  float up = zcomp(q) / height - 0.45, near = exp(-9 * up * up), width = filterwidthp(q);
  float facing = abs(normalize(N) . normalize(I));
  float threads = 0.5 * (float noise(600 * zcomp(q), 40 * u) + float noise(700 * u, 40 * zcomp(q))) - 0.5;
  Oi = Os;
  Ci = Os * mix(warm, hot, near * mix(0.55, 1, facing)) * (1 + 0.3 * threads * noisefade(600 * width));
}
