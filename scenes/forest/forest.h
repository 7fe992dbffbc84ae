/* What several shaders of this scene share: where the sun stands, the colour of the air, and the light of the sky. Points
 * and directions are in the coordinate system "forest": metres, x to the right, y up, z away from the eye.
 */
#ifndef FOREST_H
#define FOREST_H

#include "noises.h"

#define SUN normalize(vector(-0.21, 0.315, 0.926))

/* How much of the light air sends on into the eye, by the angle between the view and the sun (L. Henyey and J. Greenstein,
 * 1941): mist scatters forwards.
 */
float phase(vector d) {
  uniform float g = 0.72;
  float c = d . SUN;
  return (1 - g * g) / pow(1 + g * g - 2 * g * c, 1.5) / 4;
}

/* The colour of far air, where trunks are no longer told apart. */
color farair(vector d) {
  float up = clamp(ycomp(d), 0, 1);
  color still = mix(color(0.30, 0.36, 0.40), color(0.42, 0.55, 0.70), smoothstep(0.1, 0.5, up));
  return 0.45 * still + color(0.30, 0.195, 0.085) * phase(d);
}

/* What leaves and sky above send to a surface, as diffuse() would say; the clearing and the light behind it are in front. */
color skylight(normal n; point q) {
  float up = 0.5 + 0.5 * ycomp(n), ahead = 0.5 + 0.5 * zcomp(n);
  float open = smoothstep(0, 1.2, ycomp(q)) * 0.5 + 0.5;
  return open * (mix(color(0.05, 0.043, 0.028), color(0.22, 0.27, 0.29), up) + color(0.20, 0.155, 0.09) * ahead * ahead);
}

#endif
