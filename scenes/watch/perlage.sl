#include "movement.h"

/* Perlage is a finish of overlapping spots. A turning peg has ground each of them in circles. Later spots lie over
 * earlier ones.
 */
surface perlage(color metal = color(0.62, 0.58, 0.52); float size = 1.5;) {
  point q = transform("movement", P);
  float width = filterwidthp(q) / size, x = xcomp(q) / size, z = zcomp(q) / size;
  float row, column, latest = -1e6, bx = 0, bz = 1;
  for (row = -1; row <= 1; row += 1)
    for (column = -1; column <= 1; column += 1) {
      float r = floor(z / 0.60) + row, c = floor(x / 0.68 - 0.5 * mod(r, 2)) + column;
      float ax = x - 0.68 * (c + 0.5 + 0.5 * mod(r, 2)), az = z - 0.60 * (r + 0.5), order = c - 1000 * r;
      if (ax * ax + az * az < 0.31 && order > latest) {
        latest = order;
        bx = ax;
        bz = az;
      }
    }
  float away = sqrt(bx * bx + bz * bz);
  float lines = (float noise(26 * away, latest) - 0.5) * noisefade(26 * width);
  vector radial = vtransform("movement", "current", vector(bx, 0, bz) / max(away, 0.001));
  normal Nf = faceforward(normalize(normalize(N) + 0.10 * away * radial), I);
  float rim = 1 - 0.35 * smoothstep(0.48, 0.557, away);
  Oi = Os;
  Ci = Os * brushed(Nf, normalize(radial), metal * rim * (1 + 0.3 * lines), 0.18, 80);
}
