/* Steps and pulses, sharp ones as a filter of a given width sees them, and tiles. Names and arguments are those of the
 * header that "Advanced RenderMan" (A. Apodaca and L. Gritz, 1999) made known.
 */
#ifndef PATTERNS_H
#define PATTERNS_H

#include "filterwidth.h"

/* Goes from 0 at a to 1 at b in a straight line. */
#ifndef boxstep
#define boxstep(a, b, x) clamp(((x) - (a)) / ((b) - (a)), 0, 1)
#endif

/* The part of a sample from x - dx/2 to x + dx/2 that lies between the two edges. */
float filteredpulse(float edge0, edge1, x, dx) {
  float width = max(dx, MINFILTWIDTH);
  float from = x - width / 2;
  return max(0, (min(from + width, edge1) - max(from, edge0)) / width);
}

/* Integral of a train of pulses, each 1 in the first `edge` of its period: a sample takes its difference. */
float pulsetrainintegral(float edge, period, x) {
  float periods = floor(x / period);
  return periods * edge + min(edge, x - periods * period);
}

float filteredpulsetrain(float edge, period, x, dx) {
  float width = max(dx, MINFILTWIDTH);
  return (pulsetrainintegral(edge, period, x + width / 2) - pulsetrainintegral(edge, period, x - width / 2)) / width;
}

/* |x|, averaged over a sample by its integral, x|x|/2. */
float filteredabs(float x, dx) {
  float width = max(dx, MINFILTWIDTH);
  float from = x - width / 2, to = x + width / 2;
  return (to * abs(to) - from * abs(from)) / (2 * width);
}

/* Goes up from e0 to e1 and down from e2 to e3. */
#ifndef smoothpulse
#define smoothpulse(e0, e1, e2, e3, x) (smoothstep(e0, e1, x) - smoothstep(e2, e3, x))
#endif
#ifndef smoothpulsetrain
#define smoothpulsetrain(e0, e1, e2, e3, period, x) smoothpulse(e0, e1, e2, e3, mod(x, period))
#endif

/* A colour that differs a little for each index, by amounts in hue, saturation and lightness. */
color varyEach(color Cin; float index, varyhue, varysat, varylum) {
  color hsl = ctransform("hsl", Cin);
  color vary = color cellnoise(index + 0.5) - 0.5;
  float hue = mod(comp(hsl, 0) + varyhue * comp(vary, 0), 1);
  float saturation = clamp(comp(hsl, 1) + varysat * comp(vary, 1), 0, 1);
  float lightness = clamp(comp(hsl, 2) + varylum * comp(vary, 2), 0, 1);
  return ctransform("hsl", "rgb", color(hue, saturation, lightness));
}

/* Square tiles of size 1, every other row moved by half a tile: the tile of a position, the position in it, and the
 * part of the sample that is outside of the groove around the tile. */
float tilepattern(float ss, tt, ds, dt; float groovewidth, grooveheight;
                  output float swhichtile, twhichtile, stile, ttile) {
  twhichtile = floor(tt);
  ttile = tt - twhichtile;
  float moved = ss + (mod(twhichtile, 2) == 1 ? 0.5 : 0);
  swhichtile = floor(moved);
  stile = moved - swhichtile;
  return filteredpulsetrain(1 - groovewidth, 1, moved - groovewidth / 2, ds) *
         filteredpulsetrain(1 - grooveheight, 1, tt - grooveheight / 2, dt);
}

#endif
