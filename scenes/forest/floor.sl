#include "forest.h"

/* The floor of the wood has leaves of last year, which can be told apart near the eye. It has bare earth on the path,
 * and moss.
 */
surface floor(color earth = color(0.11, 0.072, 0.042)) {
  point q = transform("forest", P);
  float x = xcomp(q), z = zcomp(q), width = filterwidthp(q);
  float path = abs(x - (0.55 - 0.9 * sin(0.17 * z) - 0.05 * z));
  float wide = fBm(q * 0.8, 0.8 * width, 4, 2.1, 0.6), fine = fBm(q * 11, 11 * width, 4, 2.2, 0.6);

  /* Leaves fill the cells of a random pattern, and each leaf has a colour of its own. */
  float f1, f2;
  point at1, at2;
  voronoi_f1f2_3d(point(17 * x, 0, 12 * z) + 0.3 * vsnoise(q * 9), 1, f1, at1, f2, at2);
  float which = float cellnoise(at1 * 7), edge = smoothstep(0, 0.25, f2 - f1);
  color leaf = mix(color(0.22, 0.085, 0.03), color(0.46, 0.24, 0.085), which) * mix(0.35, 1, edge);
  leaf = mix(leaf, color(0.27, 0.14, 0.055), smoothstep(0.02, 0.1, width));

  float bare = 1 - smoothstep(0.35, 0.95, path + 0.5 * wide + 0.25 * fine);
  color ground = mix(leaf, earth * (1 + 0.7 * fine), 0.75 * bare);
  float moss = smoothstep(0.25, 0.6, wide + 0.3 * fine) * (1 - bare);
  ground = mix(ground, color(0.07, 0.10, 0.02) * (1 + fine), 0.8 * moss);

  normal Nn = normalize(N), Nf = Nn;
  float bump = (0.012 * fine + 0.012 * (which - 0.5) * edge * (1 - bare)) * (1 - smoothstep(0.03, 0.15, width));
  Nf = normalize(calculatenormal(P + bump * Nn));
  if (Nf . Nn < 0)
    Nf = -Nf;
  Nf = faceforward(Nf, I, Nn);
  Oi = Os;
  Ci = Os * ground * (diffuse(Nf) + skylight(ntransform("forest", Nf), q));
}
