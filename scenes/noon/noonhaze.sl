#include "noon.h"

/* Haze gives distant things the colour of the air in front of them. It is thinner higher up. */
volume noonhaze(float distance = 560, height = 70) {
  vector way = vtransform("city", I);
  float y0 = ycomp(transform("city", P - I)), y1 = ycomp(transform("city", P));
  /* The density of the haze falls with height as exp(-y / height). This is its mean along the view ray. */
  float rise = (y1 - y0) / height;
  float thin = exp(-y0 / height) * (abs(rise) < 0.001 ? 1 : (1 - exp(-rise)) / rise);
  float clear = exp(-length(way) / distance * thin);
  color air = 0.96 * skycolor(vector(xcomp(way), 0.10 * length(way), zcomp(way)));
  Ci = Ci * clear + air * (1 - clear) * Oi;
}
