/* The shaders of this scene share the direction of the sun, the colour of the air, and the light of the sky. Points and
 * directions are in the coordinate system "forest". Its units are metres, x points to the right, y up and z away from
 * the eye.
 */
#ifndef FOREST_H
#define FOREST_H

#include "noises.h"

#define SUN normalize(vector(-0.21, 0.315, 0.926))

/* Returns how much of the sun's light the air scatters towards the eye, by the angle between the view and the sun (L.
 * Henyey and J. Greenstein, 1941). Mist scatters most of its light forwards.
 */
float phase(vector d) {
  uniform float g = 0.72;
  float c = d . SUN;
  return (1 - g * g) / pow(1 + g * g - 2 * g * c, 1.5) / 4;
}

/* Returns the colour of the distant air, in which trunks cannot be told apart. */
color farair(vector d) {
  float up = clamp(ycomp(d), 0, 1);
  color still = mix(color(0.30, 0.36, 0.40), color(0.42, 0.55, 0.70), smoothstep(0.1, 0.5, up));
  return 0.45 * still + color(0.30, 0.195, 0.085) * phase(d);
}

/* Returns the light that a matte surface receives from the leaves and the sky above. Its units are those of diffuse().
 * Surfaces that face the clearing ahead receive more, because bright light lies behind it.
 */
color skylight(normal n; point q) {
  float up = 0.5 + 0.5 * ycomp(n), ahead = 0.5 + 0.5 * zcomp(n);
  float open = smoothstep(0, 1.2, ycomp(q)) * 0.5 + 0.5;
  return open * (mix(color(0.05, 0.043, 0.028), color(0.22, 0.27, 0.29), up) + color(0.20, 0.155, 0.09) * ahead * ahead);
}

#endif
