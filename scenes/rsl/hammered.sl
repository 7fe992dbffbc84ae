#include "noises.h"

/* A hammer has left dents. The metal is driven in around scattered points. Km is measured in the space of the
   object. */
displacement hammered(float Km = 0.03, frequency = 5, jitter = 0.9) {
  float nearest = 0;
  point centre = 0, q = transform("shader", P);
  voronoi_f1_3d(frequency * q, jitter, nearest, centre);
  float dent = 1 - smoothstep(0, 0.75, nearest);
  q -= Km * dent * normalize(ntransform("shader", N));
  P = transform("shader", "current", q);
  N = calculatenormal(P);
}
