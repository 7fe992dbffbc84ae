/* The shaders of this scene have to agree on the shape of the face around the eye and on its scales, so these stand
 * here. Lengths are in centimetres, x points to the right and y up, and heights point towards the viewer. The sheet of
 * skin has u along x and v along y.
 */
#ifndef DRAGON_H
#define DRAGON_H

#include "noises.h"

#define SHEETX(u) (24 * (u) - 12)
#define SHEETY(v) (16 * (v) - 8)
#define EYEX -1.3
#define EYEY 0.1

/* Returns coordinates along and across the eye, whose outer corner is the higher one. */
point eyespace(float x, y) {
  float a = x - (EYEX), b = y - (EYEY);
  return point(0.970 * a + 0.242 * b, -0.242 * a + 0.970 * b, 0);
}

/* Returns how far a place lies within the opening between the lids. It is negative outside. */
float opening(point e) {
  float t = xcomp(e) / 2.02, arch = 1 - t * t;
  float upper = 1.16 * arch - 0.10 * t, lower = 0.98 * arch + 0.12 * t;
  return min(upper - ycomp(e), lower + ycomp(e));
}

/* Returns the height of the face without scales. */
float face(float x, y) {
  point e = eyespace(x, y), q = point(x, y, 0);
  float d = length(vector e), angle = atan(ycomp(e), xcomp(e));
  float base = -0.016 * x * x - 0.030 * y * y + 0.35 * snoise(q / 4.5 + vector(5, 2, 8));
  float ball = sqrt(max(0, 5.7 - d * d)) - 1.1;
  float k = clamp(0.5 + (ball - base) / 0.7, 0, 1);
  float h = mix(base, ball, k) + 0.35 * k * (1 - k);

  /* A brow is above the eye, and pouches are below it. */
  float round = length(vector(xcomp(e) / 1.18, ycomp(e), 0));
  float above = smoothstep(0.05, 0.75, angle) * (1 - smoothstep(2.3, 3.05, angle));
  float ridge = (round - 3.05) / 0.62, socket = (round - 2.25) / 0.26;
  h += above * (1.0 * exp(-ridge * ridge) - 0.35 * exp(-socket * socket));
  float below = (1 - smoothstep(-1.1, -0.15, angle)) * smoothstep(-3.1, -2.4, angle);
  float pouch = (d - 2.75) / 0.7;
  h += below * exp(-pouch * pouch) * (0.16 * cos(8.5 * d + 0.9 * snoise(q * 0.9)));

  /* The lids have a rim, and nothing lies within them. */
  float inside = opening(e), rim = (inside + 0.10) / 0.10;
  h += 0.13 * exp(-rim * rim) * (1 - smoothstep(2.1, 2.5, d));
  return h - 1.9 * smoothstep(0, 0.10, inside);
}

/* Scales lie in rings around the eye and grow with the distance from it. They are cells on a cylinder, because the
 * logarithm maps the plane to a cylinder and keeps angles. `edge` is 0 between scales, `middle` is 0 in the middle of a
 * scale, and `which` is a random number for each scale.
 */
void scales(float x, y; output float edge, middle, which, size; output vector tilt) {
  point e = eyespace(x, y);
  uniform float around = 8.5;
  float d = max(length(vector e), 0.05), angle = atan(ycomp(e), xcomp(e));
  float wide = length(vector(xcomp(e) / 1.12, ycomp(e), 0));
  point p = around * point(cos(angle), sin(angle), log(max(wide, 0.05))) + 0.25 * vsnoise(point(x, y, 3) * 0.8);
  float f1 = 0, f2 = 0;
  point at1 = 0, at2 = 0;
  voronoi_f1f2_3d(p, 0.72, f1, at1, f2, at2);
  edge = f2 - f1;
  middle = f1;
  which = float cellnoise(at1 * 13.7);
  size = d / around;
  tilt = p - at1;
}

#endif
