#include "movement.h"

/* This gilt brass shows circles of the lathe. It is polished instead if shine is 1. */
surface gilt(color metal = color(0.95, 0.68, 0.32); float shine = 0;) {
  point q = transform("shader", P);
  float width = filterwidthp(q), r = sqrt(xcomp(q) * xcomp(q) + zcomp(q) * zcomp(q));
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  if (shine > 0.5) {
    Ci = Os * polished(Nf, metal, 0.05, 32);
  } else {
    float lines = (float noise(30 * r) - 0.5) * noisefade(30 * width) + (float noise(8 * r) - 0.5) * noisefade(8 * width);
    vector radial = normalize(vtransform("shader", "current", vector(xcomp(q), 0, zcomp(q))));
    Ci = Os * brushed(Nf, radial, metal * (1 + 0.35 * lines), 0.14, 48);
  }
}
