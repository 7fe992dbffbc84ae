#include "pool.h"

/* This is plaited straw. The plait forms rings, and strands cross them. */
surface straw(color pale = color(0.66, 0.50, 0.26), dark = color(0.36, 0.23, 0.09)) {
  point q = transform("shader", P);
  float ring = sqrt(xcomp(q) * xcomp(q) + zcomp(q) * zcomp(q)) + ycomp(q);
  float along = 90 * u, across = 160 * ring, width = max(filterwidth(along), filterwidth(across));
  float strand = abs(sin(PI * across)) * (0.6 + 0.4 * abs(sin(PI * (along + 0.5 * floor(across)))));
  strand = mix(strand, 0.5, smoothstep(0.15, 0.5, width));
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * mix(dark, pale, strand) * (0.85 + 0.3 * float noise(60 * u, 30 * ring)) * received(Nf);
}
