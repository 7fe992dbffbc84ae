#include "coast.h"

/* Haze over the sea gives distant things the colour of the sky behind them. It is thinner higher up. */
volume seahaze(float distance = 2600, height = 120) {
  vector way = vtransform("coast", I);
  float y0 = ycomp(transform("coast", P - I)), y1 = ycomp(transform("coast", P));
  /* The density of the haze falls with height as exp(-y / height). This is its mean along the view ray. */
  float rise = (y1 - y0) / height;
  float thin = exp(-y0 / height) * (abs(rise) < 0.001 ? 1 : (1 - exp(-rise)) / rise);
  float clear = exp(-length(way) / distance * thin);
  color air = skycolor(vector(xcomp(way), 0.015 * length(way), zcomp(way)));
  Ci = Ci * clear + air * (1 - clear) * Oi;
}
