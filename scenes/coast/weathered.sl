#include "coast.h"

/* This is grey wood that has stood in the wind for years. Fibres run along the post, and it has cracks. */
surface weathered(color wood = color(0.30, 0.26, 0.22)) {
  normal Nf = faceforward(normalize(N), I);
  float fibre = float noise(60 * u, 3 * v) + 0.5 * float noise(160 * u, 5 * v);
  Oi = Os;
  Ci = Os * wood * (0.35 + 0.75 * fibre) * (diffuse(Nf) + skylight(ntransform("coast", Nf)));
}
