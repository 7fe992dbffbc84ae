#include "studio.h"

/* filteredpulsetrain draws the stripes of a sailor's shirt. */
surface breton(color white = color(0.76, 0.73, 0.66), indigo = color(0.035, 0.065, 0.16)) {
  point q = potpoint();
  float z = zcomp(q) + 0.012 * snoise(2 * q);
  float stripe = filteredpulsetrain(0.15, 0.42, z - 0.1, filterwidth(z));
  Oi = Os;
  Ci = Os * glazed(mix(white, indigo, stripe), faceforward(normalize(N), I), 1, 0.03);
}
