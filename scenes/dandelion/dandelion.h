/* The shaders of this scene share the direction of the sun, the place of the dandelion's head, and the light of sky and
 * meadow. Directions are in the coordinate system "meadow": x points to the right, y up and z away from the eye.
 */
#ifndef DANDELION_H
#define DANDELION_H

#include "noises.h"

#define SUN normalize(vector(-0.50, 0.42, 0.76))
#define HEAD point(-27, 6, 0)

/* Returns the light that a matte surface receives from sky and meadow. Its units are those of diffuse(). */
color skylight(vector n) {
  float up = 0.5 + 0.5 * ycomp(n), ahead = 0.5 + 0.5 * zcomp(n);
  return mix(color(0.07, 0.085, 0.03), color(0.22, 0.26, 0.34), up) + color(0.30, 0.20, 0.08) * ahead * ahead;
}

#endif
