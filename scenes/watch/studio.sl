#include "movement.h"

/* Rays that leave the watch meet this surface. The eye does not look there directly. */
surface studio() {
  Oi = 1;
  Ci = studiolight(normalize(vtransform("movement", I)));
}
