#include "studio.h"

/* turbulence draws the rings of malachite. */
surface malachite(color dark = color(0.012, 0.085, 0.055), light = color(0.16, 0.46, 0.30)) {
  point q = potpoint();
  float width = filterwidthp(q);
  float rings = 2.1 * turbulence(0.42 * q + vector(5, 2, 1), 0.42 * width, 3, 2.0, 0.45) + 0.1 * zcomp(q);
  float fine = float noise(34 * rings), bands = 0.5 + 0.5 * sin(2 * PI * 7 * rings);
  color paint = mix(dark, light, clamp(0.7 * bands * bands + 0.55 * fine - 0.12, 0, 1));
  Oi = Os;
  Ci = Os * glazed(paint, faceforward(normalize(N), I), 1, 0.02);
}
