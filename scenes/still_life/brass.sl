#include "room.h"

/* This old brass has patches of dull, brown tarnish and is polished elsewhere. */
surface brass() {
  point q = transform("shader", P);
  float tarnish = smoothstep(-0.2, 0.55, fBm(q * 2.4, 2.4 * filterwidthp(q), 5, 2.1, 0.55));
  normal Nf = faceforward(normalize(calculatenormal(P + 0.003 * snoise(q * 9) * normalize(N))), I);
  vector V = -normalize(I);
  float grazing = pow(1 - abs(Nf . V), 5);
  color tint = mix(Cs * mix(1, 0.55, tarnish), color(1), grazing);
  color mirrored = mirror(P, reflect(-V, Nf), 0.06, 24);
  Oi = Os;
  Ci = Os * (tint * mirrored + 0.10 * tarnish * color(0.4, 0.25, 0.1) * received(Nf));
}
