#include "coast.h"

/* The sun shines through the petals of a poppy, so both of their sides glow. */
surface poppy(color petal = color(1.0, 0.33, 0.03)) {
  color sun = 0;
  illuminance (P, vector(0, 1, 0), PI) sun += 0.55 * Cl;
  Oi = Os;
  Ci = Os * petal * mix(0.75, 1.1, v) * (sun + skylight(normal(0, 1, 0)));
}
