#include "movement.h"

/* What rays meet that leave the watch. The eye itself does not look there. */
surface studio() {
  Oi = 1;
  Ci = studiolight(normalize(vtransform("movement", I)));
}
