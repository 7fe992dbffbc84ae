#include "filterwidth.h"

/* Tiles of two colours alternate, with joints between them. The pattern is averaged over the area of a sample, as
   the difference of an integral at its two ends. Tiles near the horizon therefore melt into grey. */
float stripes(float x, width) {
  /* Returns the integral of a wave that is 1 for x in 0..1, 0 in 1..2, and so on. */
  float integral(float y) { return floor(y / 2) + min(mod(y, 2), 1); }
  return (integral(x + width / 2) - integral(x - width / 2)) / width;
}

surface tiles(float Ka = 1, Kd = 0.8, Ks = 0.3, roughness = 0.04, Kr = 0.25;
              float size = 0.8, joint = 0.02;
              color first = color(0.55, 0.52, 0.46), second = color(0.1, 0.12, 0.13), jointcolor = color(0.2, 0.19, 0.18)) {
  point q = transform("shader", P) / size;
  float x = xcomp(q), y = zcomp(q);
  float dx = filterwidth(x), dy = filterwidth(y);
  float a = stripes(x, dx), b = stripes(y, dy);
  color pattern = mix(first, second, a + b - 2 * a * b);
  /* Returns how much of the sample lies outside the joints. */
  float whole(float z, dz) {
    extern float joint;
    uniform float open = 1 - joint;
    float upto(float w) { extern uniform float open; return floor(w) * open + min(mod(w, 1), open); }
    return (upto(z + dz / 2) - upto(z - dz / 2)) / dz;
  }
  float glazed = whole(x, dx) * whole(y, dy);
  pattern = mix(jointcolor, pattern, glazed);

  normal Nf = faceforward(normalize(N), I);
  vector In = normalize(I);
  color mirrored = 0;
  if (Kr * glazed > 0.001) {
    float reflected, through;
    fresnel(In, Nf, 1 / 1.5, reflected, through);
    mirrored = (Kr + (1 - Kr) * reflected) * glazed * trace(P, reflect(In, Nf));
  }
  Oi = Os;
  Ci = Os * (pattern * (Ka * ambient() + Kd * diffuse(Nf)) +
             glazed * Ks * specular(Nf, -In, roughness) + Kr * mirrored);
}
