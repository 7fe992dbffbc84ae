#include "noises.h"

/* This is white polished stone with dark veins. */
surface marble(float Ka = 1, Kd = 0.75, Ks = 0.5, roughness = 0.06;
               float frequency = 1.3, veins = 3, swirl = 1.6;
               color veincolor = color(0.12, 0.13, 0.2);
               output varying float vein = 0) {
  /* The pattern moves with the object. */
  point q = frequency * transform("shader", P);
  float width = filterwidthp(q);
  float bend = fBm(q, width, 5, 2, 0.5);
  /* Noise bends a wave that runs through the stone. The zeros of the wave are the veins. */
  float wave = sin(veins * (xcomp(q) + 0.6 * ycomp(q)) + 2 * PI * swirl * bend);
  vein = pow(1 - abs(wave), 4);
  vein *= 0.35 + 0.65 * smoothstep(-0.3, 0.3, snoise(1.7 * q));
  color stone = mix(Cs, veincolor, vein);
  stone *= 1 - 0.12 * fBm(4 * q, 4 * width, 3, 2, 0.5);

  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  Oi = Os;
  Ci = Os * (stone * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, V, roughness));
}
