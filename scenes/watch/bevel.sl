#include "movement.h"

/* This bevel has been polished by hand. */
surface bevel(color metal = color(0.90, 0.84, 0.74)) {
  Oi = Os;
  Ci = Os * polished(faceforward(normalize(N), I), metal, 0.05, 32);
}
