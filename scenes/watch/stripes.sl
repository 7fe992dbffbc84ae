#include "movement.h"

/* Geneva stripes are bands that a turning disk has cut. Its scratches run across the bands in arcs. */
surface stripes(color metal = color(0.84, 0.81, 0.76); float wide = 1.9;) {
  point q = transform("movement", P);
  float along = 0.80 * xcomp(q) + 0.60 * zcomp(q), across = (0.80 * zcomp(q) - 0.60 * xcomp(q)) / wide;
  float band = mod(across, 1), width = filterwidthp(q);
  float bent = along + 0.45 * wide * 4 * band * (1 - band);
  float scratches = (float noise(30 * bent, 3 * floor(across)) - 0.5) * noisefade(30 * width) + (float noise(7 * bent, floor(across)) - 0.5) * noisefade(7 * width);
  vector over = normalize(vtransform("movement", "current", vector(-0.6, 0, 0.8))), on = normalize(vtransform("movement", "current", vector(0.8, 0, 0.6)));
  /* The disk was tilted, so each band is a shallow step, and its two sides take the light differently. */
  normal Nf = faceforward(normalize(normalize(N) + 0.24 * (band - 0.5) * over), I);
  Oi = Os;
  Ci = Os * brushed(Nf, on, metal * (1 + 0.3 * scratches), 0.13, 48);
}
