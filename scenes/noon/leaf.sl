#include "noon.h"

/* The sun shines through the leaves of a plane tree. Leaves within the crown see little of the sky: `open` tells how
 * much.
 */
surface leaf(float open = 1; float which = 0.5) {
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  color tint = mix(color(0.060, 0.125, 0.020), color(0.17, 0.235, 0.045), which);
  color before = 0, through = 0;
  illuminance ("sun", P, vector(0, 1, 0), PI) {
    float facing = normalize(L) . Nf;
    if (facing > 0)
      before += Cl * (facing + 0.10 * pow(max(0, normalize(normalize(L) + V) . Nf), 20) / 0.12);
    else
      through += Cl * -facing;
  }
  color light = skylight(normalize(ntransform("city", Nf))) * (0.25 + 0.75 * open);
  Oi = Os;
  Ci = Os * (tint * (before + 1.5 * light) + color(1.5, 1.5, 0.55) * tint * (0.75 * through + 0.55 * light));
}
