#include "noon.h"

/* The street is asphalt with painted lines, patches, wheel tracks and oil stains. With flags = 1 the shader draws the
 * stone slabs of the pavement beside it.
 */
surface street(float flags = 0) {
  point q = transform("city", P);
  normal Nf = faceforward(normalize(N), I);
  float x = xcomp(q), z = zcomp(q), soft = max(filterwidthp(q), 0.001);
  color tint = mix(color(0.155, 0.15, 0.145), color(0.36, 0.345, 0.32), flags);
  float paint = 0;
  if (isindirectray() == 0) {
    float wide = fBm(0.35 * q, 0.35 * soft, 4, 2.1, 0.55), fine = fBm(point(60 * x, 0, 60 * z), 60 * soft, 2, 2, 0.6);
    tint *= 1 + 0.22 * wide + 0.3 * fine;
    if (flags > 0) {
      float row = z / 0.8, column = x / 0.6 + 0.5 * mod(floor(row), 2);
      float joint = max(stroke(mod(row, 1), 0.5, 0.022, soft / 0.8), stroke(mod(column, 1), 0.5, 0.028, soft / 0.6));
      tint *= 1 + 0.22 * (float cellnoise(floor(column - 0.5), floor(row - 0.5)) - 0.5);
      tint *= 1 - 0.5 * joint * (1 - smoothstep(0.05, 0.2, soft));
    } else {
      /* Tyres polish two tracks in each lane. Oil drips between them. */
      float lane = abs(abs(x) - 2.2), track = exp(-pow((lane - 0.75) / 0.28, 2)), oil = exp(-pow(lane / 0.32, 2));
      tint *= 1 + 0.12 * track - (0.22 + 0.12 * wide) * oil;
      /* Some trenches have been dug and filled again. */
      float cell = cellnoise(floor((x + 7) / 3.5), floor(z / 9));
      float patchx = mod(x + 7, 3.5), patchz = mod(z, 9);
      float filled = (cell > 0.76 ? 1 : 0) * between(patchx, 0.5, 2.4, soft) * between(patchz, 1.2, 3 + 4 * cell, soft);
      tint *= 1 - 0.28 * filled;
      /* The asphalt has cracks. */
      float crack = 1 - abs(snoise(0.55 * q + 0.35 * vsnoise(1.7 * q)));
      tint *= 1 - 0.3 * smoothstep(-0.1, 0.4, wide) * smoothstep(0.98, 0.994, crack) * (1 - smoothstep(0.02, 0.12, soft));
      /* Painted lines mark the middle, the lanes of parked cars, and a crossing. */
      float wear = smoothstep(-0.55, 0.25, fBm(2.2 * q, 2.2 * soft, 4, 2.2, 0.6) + 0.12 * fine);
      float dash = between(mod(z, 6), 0.5, 3.5, soft);
      paint = max(stroke(abs(x), 0.13, 0.11, soft), dash * stroke(abs(x), 4.55, 0.10, soft));
      paint *= 1 - between(z, 7.5, 13.2, soft);
      paint = max(paint, between(z, 8.4, 12, soft) * between(abs(x), 0, 6.6, soft) * stroke(mod(x, 1.1), 0.55, 0.55, soft));
      paint = max(paint, between(z, 7.1, 7.5, soft) * between(x, 0.3, 6.6, soft));
      paint *= 0.25 + 0.62 * wear;
    }
  }
  tint = mix(tint, color(0.66, 0.655, 0.63), paint);
  vector In = normalize(I);
  color gloss = 0.10 * pow(1 - abs(In . Nf), 5) * skycolor(vector(0, 0.25, 1));
  Oi = Os;
  Ci = Os * (tint * received(Nf, isindirectray() + raydepth()) + gloss);
}
