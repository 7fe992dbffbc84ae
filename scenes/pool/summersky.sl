#include "pool.h"

/* The sky has a few thin clouds. */
surface summersky() {
  vector d = normalize(vtransform("court", I));
  float up = max(ycomp(d), 0);
  point q = 4 * point(xcomp(d), 3.5 * up, zcomp(d));
  float cloud = smoothstep(0.1, 0.8, fBm(q, filterwidthp(q), 6, 2.1, 0.55)) * smoothstep(0.02, 0.25, up);
  Oi = 1;
  Ci = mix(skycolor(d), color(0.95, 0.93, 0.90), 0.5 * cloud);
}
