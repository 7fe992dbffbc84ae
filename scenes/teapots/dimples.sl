#include "studio.h"

#include "displace.h"

/* Displace and voronoi_f1_3d make the dents of a hammer. */
displacement dimples(float depth = 0.05) {
  point q = potpoint();
  float f1 = 0;
  point p1 = 0;
  voronoi_f1_3d(3.0 * q, 0.8, f1, p1);
  N = Displace(normalize(N), "object", depth * f1 * f1, 1);
}
