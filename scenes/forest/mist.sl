#include "forest.h"

/* Morning mist is thicker near the ground. The shader walks from the eye to the surface in steps, and each step glows
 * if the sun reaches it.
 */
volume mist(float density = 0.015, steps = 48, reach = 75) {
  point q0 = transform("forest", P - I), q1 = transform("forest", P);
  vector d = normalize(q1 - q0), along = normalize(I);
  float way = min(length(q1 - q0), reach), jitter = random();
  float clear = 1, towards = phase(d);
  color glow = 0;
  uniform float k;
  for (k = 0; k < steps; k += 1) {
    /* Steps grow with the distance from the eye. */
    float near = (k + jitter) / steps, far = way * near * (0.35 + 0.65 * near), wide = way * (0.35 + 1.3 * near) / steps;
    point q = q0 + far * d;
    float thick = density * (0.6 + 1.0 * exp(-max(ycomp(q), 0) / 2.2)) * smoothstep(0, 9, far);
    color lit = 0;
    illuminance ("sun", P - I + far * along, vector(0, 0, 1), PI) lit += Cl;
    glow += clear * thick * wide * (0.085 * towards * lit + color(0.06, 0.08, 0.095) + color(0.05, 0.035, 0.02) * towards);
    clear *= exp(-thick * wide);
  }
  /* Beyond the shadow map, all air looks the same. */
  float beyond = exp(-0.012 * max(0, length(q1 - q0) - reach));
  Ci = (Ci * beyond + farair(d) * (1 - beyond) * Oi) * clear + Oi * glow;
}
