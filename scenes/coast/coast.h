/* The shaders of this scene have to agree on the height of the land, the brightness of the sky and the direction of the
 * sun, so these stand here. Points and directions are in the coordinate system "coast". Its units are metres, x points
 * to the right, y up and z away from the eye. The sea lies at y = 0.
 */
#ifndef COAST_H
#define COAST_H

#include "noises.h"

#define SUN normalize(vector(-0.9, 0.25, -0.12))

/* Returns the x of the shore at a distance z. It follows the bay in front of the eye, the headland, and two more
 * headlands behind it.
 */
float shore(float z) {
  float headland = (z - 720) / 165, second = (z - 2500) / 420, third = (z - 6500) / 1100;
  return 95 - 245 * exp(-headland * headland) - 850 * exp(-second * second) - 2900 * exp(-third * third);
}

/* Returns the height of a rock that stands in the sea and has steep sides. */
float stack(float x, z, ragged, centrex, centrez, radius, top) {
  float far = sqrt((x - centrex) * (x - centrex) + (z - centrez) * (z - centrez)) / radius + 0.5 * ragged;
  return -6 + (top + 6) * (1 - smoothstep(0.55, 1, far));
}

/* Returns the height of the land above the sea in metres, without details that are smaller than a few metres. */
float landheight(float x, z) {
  point q = point(x, 0, z);
  float ragged = snoise(q / 14), wide = snoise(q / 75);
  /* This is the distance inland. Gullies cut into the edge of the cliff. */
  float gully = 1 - abs(snoise(q / 38 + vector(7, 0, 3)));
  float inland = x - shore(z) + 22 * wide + 5 * ragged - 13 * gully * gully;
  float cliff = 34 + 0.028 * clamp(z, 0, 900) + 16 * snoise(q / 230);
  float hills = 46 * (0.8 + snoise(q / 310 + vector(3, 0, 1)) + 0.35 * snoise(q / 120));

  float y = -6 + 9 * smoothstep(-70, 16, inland);
  y += cliff * (0.86 * smoothstep(10, 30 + 6 * wide, inland) + 0.14 * smoothstep(25, 90, inland));
  y += hills * smoothstep(40, 420, inland);

  y = max(y, stack(x, z, ragged, -196, 700, 21, 31));
  y = max(y, stack(x, z, ragged, -232, 722, 12, 15));
  y = max(y, stack(x, z, ragged, -38, 395, 9, 7));
  return y;
}

/* Returns how densely shrubs cover a place on the meadows, from 0 to 1. They grow in groups. */
float shrubs(point q) {
  return smoothstep(0.60, 0.72, float noise(q / 5.5)) * smoothstep(0.52, 0.62, float noise(q / 70 + vector(2, 0, 9)));
}

/* Returns the radiance of the sky without clouds. It is blue above, pale at the horizon, and golden near the sun. */
color skycolor(vector direction) {
  vector d = normalize(direction);
  float near = 0.5 + 0.5 * (d . SUN), up = max(ycomp(d), 0);
  color horizon = mix(color(0.50, 0.50, 0.57), color(1.30, 0.86, 0.46), pow(near, 2.2));
  color above = mix(color(0.07, 0.19, 0.46), color(0.24, 0.38, 0.60), near);
  return mix(horizon, above, pow(min(1, 1.9 * up), 0.55));
}

/* Returns the light that a matte surface receives from the sky above and from the land and sea below. Its units are
 * those of diffuse().
 */
color skylight(normal up) {
  float facing = 0.5 + 0.5 * ycomp(normalize(up));
  float sunny = 0.5 + 0.5 * (normalize(vector up) . SUN);
  return mix(color(0.10, 0.075, 0.05), mix(color(0.17, 0.24, 0.40), color(0.42, 0.38, 0.36), sunny), facing);
}

#endif
