#include "studio.h"

/* VLNoise draws grey veins in white marble. It is noise that is shifted by noise. */
surface marble(color white = color(0.78, 0.76, 0.73), vein = color(0.17, 0.18, 0.20)) {
  point q = potpoint();
  float width = filterwidthp(q);
  float thick = 1 - abs(VLNoise(0.55 * q + vector(3, 1, 7), 1.6) + 0.25 * fBm(1.7 * q, 1.7 * width, 5, 2.1, 0.55));
  float cloud = 0.5 + 0.5 * fBm(0.8 * q, 0.8 * width, 4, 2, 0.5);
  color paint = mix(white, vein, 0.9 * pow(thick, 9) + 0.12 * cloud);
  Oi = Os;
  Ci = Os * glazed(paint, faceforward(normalize(N), I), 1, 0.03);
}
