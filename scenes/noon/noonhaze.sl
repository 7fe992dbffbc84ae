#include "noon.h"

/* Haze: what is far takes the colour of the air before it, the less the higher it stands. */
volume noonhaze(float distance = 560, height = 70) {
  vector way = vtransform("city", I);
  float y0 = ycomp(transform("city", P - I)), y1 = ycomp(transform("city", P));
  /* The mean of exp(-y / height) on the way from the eye. */
  float rise = (y1 - y0) / height;
  float thin = exp(-y0 / height) * (abs(rise) < 0.001 ? 1 : (1 - exp(-rise)) / rise);
  float clear = exp(-length(way) / distance * thin);
  color air = 0.96 * skycolor(vector(xcomp(way), 0.10 * length(way), zcomp(way)));
  Ci = Ci * clear + air * (1 - clear) * Oi;
}
