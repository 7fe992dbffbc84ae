#include "noon.h"

/* This shader serves painted wood, iron, rubber and slate. It gives a slightly uneven colour and an optional gloss.
 * `stripes` is the width of a pair of an awning's stripes in metres, and 0 means none. `formula` is 1 on surfaces for
 * which no indirect light is computed.
 */
surface plain(float gloss = 0, stripes = 0, uneven = 0.15, formula = 0; color second = color(0.8, 0.78, 0.72)) {
  point q = transform("city", P);
  normal Nf = faceforward(normalize(N), I);
  color tint = Cs;
  if (stripes > 0) tint = mix(tint, second, smoothstep(-0.15, 0.15, sin(2 * PI * zcomp(q) / stripes)));
  if (isindirectray() == 0) tint *= 1 + uneven * fBm(3 * q, 3 * filterwidthp(q), 4, 2.1, 0.6);
  Oi = Os;
  Ci = Os * tint * received(Nf, formula + isindirectray() + raydepth());
  if (gloss > 0) Ci += gloss * mirrored(Nf, 1.4, 0, 1);
}
