#include "noon.h"

/* A window, seen from outside, reflects the street in front of a dark room with curtains. No two panes reflect alike. s
 * and t run from 0 to 1 over the pane.
 */
surface pane(uniform float which = 0.5; float shop = 0) {
  normal Nf = faceforward(normalize(N), I);
  point q = transform("city", P);
  vector bend = vsnoise(0.7 * q + vector(17 * which, 0, 0)) * 0.014 + (vector cellnoise(41 * which + 0.5) - vector(0.5, 0.5, 0.5)) * 0.02;
  normal Nb = normalize(Nf + ntransform("city", "current", normal bend));
  float fold = 0.5 + 0.5 * sin(60 * s + 6 * sin(7 * s + 40 * which));
  float drawn = 0.10 + 0.30 * float cellnoise(97 * which + 3), cloth = max(1 - smoothstep(drawn - 0.01, drawn + 0.01, s), smoothstep(0.99 - drawn, 1.01 - drawn, s));
  float blind = (cellnoise(53 * which + 7) > 0.72 ? 1 : 0) * smoothstep(0.45, 0.47, t);
  color room = color(0.012, 0.013, 0.014) + color(0.02, 0.018, 0.015) * (1 - t);
  color inside = mix(room, color(0.22, 0.21, 0.19) * (0.55 + 0.45 * fold), 0.8 * cloth);
  inside = mix(inside, color(0.34, 0.32, 0.27), blind);
  if (shop > 0) {
    /* A shop has shelves with goods. */
    float row = 4 * t, goods = float cellnoise(9 * s + 31 * which, floor(row));
    color ware = mix(color(0.05, 0.045, 0.04), color cellnoise(floor(9 * s) + 31 * which + 0.5, floor(row) + 0.5) * color(0.16, 0.11, 0.07), 0.7);
    float here = step(mod(row, 1), 0.35 + 0.5 * goods) * step(row, 3) * step(0.5, cellnoise(23 * which + 1));
    inside = mix(color(0.03, 0.027, 0.022), ware + color(0.03, 0.025, 0.02), here);
  }
  Oi = Os;
  Ci = isindirectray() > 0 ? color(0.06, 0.06, 0.06) : inside + 1.15 * mirrored(Nb, 1.9, 0, 1);
}
