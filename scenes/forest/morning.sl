#include "forest.h"

/* This is the sky between the trunks. */
surface morning() {
  vector d = normalize(vtransform("forest", I));
  Oi = 1;
  Ci = 1.3 * farair(d);
}
