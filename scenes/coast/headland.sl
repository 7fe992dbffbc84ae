#include "coast.h"

/* This displacement raises a flat sheet to hills and cliffs. It gives the cliffs layers of harder and softer rock. It
 * tells the surface shader where each point of the rock would be without ledges, because stains run straight down there.
 */
displacement headland(float strata = 1.9, crag = 2.4; output varying point bare = 0) {
  point q = transform("coast", P);
  float y = landheight(xcomp(q), zcomp(q));
  vector up = vtransform("coast", "current", vector(0, 1, 0));
  /* A normal that is computed from the surface may point to either side. The flat sheet tells which of the two sides is
   * the upper one.
   */
  float outer = sign(calculatenormal(P) . up);
  P += y * up;
  N = outer * calculatenormal(P);

  /* Steep ground is rock. It moves along its normal, so that ledges stand out of the cliff. */
  normal slope = normalize(ntransform("coast", N));
  float steep = smoothstep(0.25, 0.6, 1 - abs(ycomp(slope))) * smoothstep(-1, 4, y);
  point r = point(xcomp(q), y, zcomp(q));
  bare = r;
  float bed = y / 5.2 + 0.5 * snoise(r / 40) + 0.09 * xcomp(q) / 5;
  float ledge = smoothstep(0.15, 0.5, mod(bed, 1)) - smoothstep(0.75, 1, mod(bed, 1));
  float rock = strata * (ledge - 0.5) + crag * (turbulence(r / 9, 0, 6, 2.1, 0.55) - 0.6);
  float meadow = 0.5 * fBm(r / 7, 0, 3, 2, 0.5) + 1.9 * shrubs(r);
  P += length(up) * mix(meadow, rock, steep) * normalize(vector N);
  N = outer * calculatenormal(P);
}
