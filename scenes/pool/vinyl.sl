#include "pool.h"

/* This is inflated vinyl, white with coral stripes, which reflects the courtyard. */
surface vinyl(color stripe = color(0.80, 0.11, 0.06), ground = color(0.82, 0.80, 0.76); float stripes = 6;) {
  float wide = mod(u * stripes, 1);
  float band = filterstep(0.25, wide) - filterstep(0.75, wide);
  /* Creases run across the seam, where the vinyl is welded. */
  float seam = 1 - smoothstep(0, 0.05, abs(v - 0.25));
  point moved = P + 0.004 * seam * snoise(90 * u) * normalize(N);
  normal Nf = faceforward(normalize(calculatenormal(moved)), I);
  Oi = Os;
  Ci = Os * (mix(ground, stripe, band) * received(Nf) + gloss(Nf, 1.5, 0.02, 4));
}
