#include "noon.h"

/* A wheel is a disk with ten spokes of light metal in front of the dark brake. */
surface wheel() {
  normal Nf = faceforward(normalize(N), I);
  point q = transform("shader", P);
  float r = sqrt(ycomp(q) * ycomp(q) + zcomp(q) * zcomp(q)) / 0.215, angle = atan(ycomp(q), zcomp(q));
  float soft = filterwidthp(q) / 0.215;
  float spoke = smoothstep(-0.25, 0.05, cos(10 * angle) - 0.1);
  float metal = max(max(1 - smoothstep(0.3, 0.3 + soft, r), smoothstep(0.86, 0.86 + soft, r)), spoke);
  vector In = normalize(I);
  Oi = Os;
  Ci = Os * mix(color(0.03, 0.03, 0.03), color(0.5, 0.5, 0.51), metal) * received(Nf, isindirectray() + raydepth());
  Ci += metal * 0.25 * skycolor(vtransform("city", reflect(In, Nf)));
}
