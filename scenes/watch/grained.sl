#include "movement.h"

/* A file has been drawn along x over this gilt brass, so its scratches are long and fine. */
surface grained(color metal = color(0.93, 0.70, 0.39)) {
  point q = transform("movement", P);
  float x = xcomp(q), z = zcomp(q), width = filterwidthp(q);
  float fine = (float noise(0.5 * x, 26 * z) - 0.5) * noisefade(26 * width), broad = (float noise(0.15 * x + 5, 7 * z) - 0.5) * noisefade(7 * width);
  vector across = normalize(vtransform("movement", "current", vector(0, 0, 1)));
  Oi = Os;
  Ci = Os * brushed(faceforward(normalize(N), I), across, metal * (1 + 0.5 * fine + 0.3 * broad), 0.16, 48);
}
