#include "movement.h"

/* These scratches run outwards from the middle in spirals. */
surface sunray(color metal = color(0.92, 0.70, 0.38)) {
  point q = transform("shader", P);
  float x = xcomp(q), z = zcomp(q), r = sqrt(x * x + z * z), angle = atan(z, x) + 0.09 * r;
  float lines = float noise(70 * angle) + 0.8 * float noise(25 * angle) - 0.9;
  vector around = normalize(vtransform("shader", "current", vector(-z, 0, x)));
  Oi = Os;
  Ci = Os * brushed(faceforward(normalize(N), I), around, metal * (1 + 0.25 * lines), 0.16, 48);
}
