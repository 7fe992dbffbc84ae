#include "room.h"

/* This is unbleached linen. Its threads cross, and are thicker in some places than in others. A blue stripe runs along
 * two of its sides.
 */
surface linen(color flax = color(0.62, 0.57, 0.48), stripe = color(0.10, 0.16, 0.27); float threads = 260;) {
  normal Nf = faceforward(normalize(N), I);
  float warp = 0.5 + 0.5 * sin(2 * PI * threads * u), weft = 0.5 + 0.5 * sin(2 * PI * threads * v);
  float slub = float noise(threads * u, 9 * v) + float noise(9 * u, threads * v);
  float width = threads * max(filterwidth(u), filterwidth(v));
  float weave = mix(0.5, max(warp, weft), 1 - smoothstep(0.3, 0.9, width));
  float across = min(abs(u - 0.06), abs(u - 0.94));
  float band = 1 - smoothstep(0.012, 0.015, across) + 1 - smoothstep(0.003, 0.005, abs(across - 0.026));
  color dyed = mix(flax, stripe, 0.85 * clamp(band, 0, 1));
  Oi = Os;
  Ci = Os * dyed * (0.86 + 0.2 * (weave - 0.5) + 0.14 * slub) * received(Nf);
}
