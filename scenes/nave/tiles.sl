#include "noises.h"

/* Worn tiles alternate between dark and pale. They reflect the hall where feet have polished them. */
surface tiles(color pale = color(0.46, 0.41, 0.33), dark = color(0.095, 0.085, 0.08); float size = 0.62;) {
  point q = transform("hall", P);
  float x = (xcomp(q) + zcomp(q)) / (1.4142 * size), y = (xcomp(q) - zcomp(q)) / (1.4142 * size);
  float width = filterwidthp(q);
  float tone = cellnoise(floor(x), floor(y));
  color paint = mod(floor(x) + floor(y), 2) < 1 ? pale : dark;
  float worn = fBm(q / 1.6, width / 1.6, 5, 2.1, 0.55);
  paint *= 0.85 + 0.3 * tone;
  paint = mix(paint, 0.5 * (pale + dark) * 0.7, clamp(0.22 + 0.3 * worn, 0, 0.6));
  float edge = size * min(min(mod(x, 1), 1 - mod(x, 1)), min(mod(y, 1), 1 - mod(y, 1)));
  float joint = (1 - smoothstep(0.004, 0.008 + width, edge)) * (1 - smoothstep(0.01, 0.05, width));
  paint *= 1 - 0.5 * joint;
  normal Nf = faceforward(normalize(N), I);
  normal bumped = faceforward(normalize(calculatenormal(P + 0.0012 * fBm(q * 0.9, 0.9 * width, 2, 2, 0.5) * normalize(N))), I);
  vector In = normalize(I);
  float Kr, Kt;
  fresnel(In, bumped, 1 / 1.5, Kr, Kt);
  color mirrored = color(0.1, 0.09, 0.08);
  if (raydepth() == 0) mirrored = trace(P, normalize(reflect(In, bumped)), "samplecone", 0.07, "samples", 96);
  Oi = Os;
  Ci = Os * (paint * (diffuse(Nf) + ambient()) + (0.75 - 0.3 * clamp(worn, 0, 1)) * (1 - joint) * Kr * mirrored);
}
