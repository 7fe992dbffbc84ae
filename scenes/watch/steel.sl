#include "movement.h"

/* This steel has a fine polish. */
surface steel(color metal = color(0.62, 0.61, 0.60)) {
  Oi = Os;
  Ci = Os * polished(faceforward(normalize(N), I), metal, 0.06, 32);
}
