#include "pool.h"

/* Glass tiles of 4 cm lie in pale joints, and no two tiles have quite the same blue. All light comes through the water.
 * Photons bring the sunlight. The water adds scattered light, and it adds less the deeper the tile lies.
 */
surface mosaic(color deep = color(0.05, 0.34, 0.42), pale = color(0.20, 0.55, 0.58), joint = color(0.62, 0.70, 0.68), scattered = color(0.10, 0.20, 0.22); float size = 0.04; string photons = "";) {
  point q = transform("court", P);
  float a, b;
  onplane(a, b);
  a /= size;
  b /= size;
  float width = max(filterwidth(a), filterwidth(b));
  float tone = cellnoise(a, b), clouds = fBm(point(0.05 * a, 0.05 * b, 0.5), 0.05 * width, 3, 2.1, 0.5);
  color tile = mix(deep, pale, clamp(0.5 + 0.9 * (tone - 0.5) * (1 - smoothstep(0.5, 2, width)) + 0.35 * clouds, 0, 1));
  float edge = min(min(mod(a, 1), 1 - mod(a, 1)), min(mod(b, 1), 1 - mod(b, 1)));
  float line = mix(1 - smoothstep(0.05, 0.05 + max(width, 0.05), edge), 0.16, smoothstep(0.3, 0.9, width));
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * mix(tile, joint, 0.8 * line) * (caustics(photons, Nf) + scattered * exp(0.5 * ycomp(q)));
}
