/* What several shaders of this scene share: where the sun stands, and the colour of the meadow's air and of its sky.
 * Directions are in the coordinate system "meadow": x to the right, y up, z away from the eye.
 */
#ifndef DANDELION_H
#define DANDELION_H

#include "noises.h"

#define SUN normalize(vector(-0.50, 0.42, 0.76))
#define HEAD point(-27, 6, 0)

/* What sky and meadow send to something, as diffuse() would say. */
color skylight(vector n) {
  float up = 0.5 + 0.5 * ycomp(n), ahead = 0.5 + 0.5 * zcomp(n);
  return mix(color(0.07, 0.085, 0.03), color(0.22, 0.26, 0.34), up) + color(0.30, 0.20, 0.08) * ahead * ahead;
}

#endif
