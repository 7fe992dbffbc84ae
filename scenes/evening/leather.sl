#include "room.h"

/* Old leather has a fine grain and creases. It is paler where people have sat on it. */
surface leather(color hide = color(0.30, 0.105, 0.032), worn = color(0.42, 0.19, 0.075)) {
  point q = transform("shader", P);
  float width = filterwidthp(q), cell;
  point centre;
  voronoi_f1_3d(190 * q, 1, cell, centre);
  float grain = (cell - 0.4) * noisefade(190 * width);
  float creases = pow(1 - abs(fBm(point(7 * xcomp(q), 16 * ycomp(q), 7 * zcomp(q)), 16 * width, 3, 2.1, 0.5)), 8);
  float rubbed = smoothstep(-0.2, 0.7, fBm(3.5 * q, 3.5 * width, 5, 2.1, 0.55));
  normal Nf = faceforward(normalize(calculatenormal(P - (0.0009 * grain + 0.0014 * creases) * normalize(N))), I);
  color tone = mix(hide, worn, 0.7 * rubbed) * (1 - 0.35 * creases);
  Oi = Os;
  Ci = Os * (tone * received(Nf) + mix(0.9, 0.5, rubbed) * gloss(Nf, 1.45, 0.22, 12));
}
