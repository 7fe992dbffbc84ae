#include "room.h"

/* A cut lemon shows its peel, its white pith, and ten wedges of pulp. The cells of the pulp point to the middle. */
surface pulp(float radius = 0.447, wedges = 10; color juice = color(0.86, 0.66, 0.16), pith = color(0.86, 0.82, 0.62), peel = color(0.85, 0.55, 0.04);) {
  point q = transform("shader", P);
  float r = sqrt(xcomp(q) * xcomp(q) + ycomp(q) * ycomp(q)) / radius, angle = atan(ycomp(q), xcomp(q)) / (2 * PI) + 0.5;
  float wedge = wedges * angle + 0.12 * snoise(point(3 * xcomp(q), 3 * ycomp(q), 1)), across = abs(mod(wedge, 1) - 0.5);
  /* This is the distance to the skin between two wedges, in radii. */
  float skin = (0.5 - across) * 2 * PI * r / wedges;
  float ragged = 0.012 * snoise(q * 14);
  float inside = smoothstep(0.012, 0.03, skin + 0.4 * ragged) * (1 - smoothstep(0.82, 0.85, r + ragged)) * smoothstep(0.09, 0.13, r + ragged);
  float cells = float noise(point(9 * r, 70 * angle, 3)) + 0.6 * float noise(point(16 * r, 150 * angle, 8));
  color flesh = juice * (0.62 + 0.45 * cells) * mix(1.1, 0.85, r);
  color paint = mix(pith, flesh, inside);
  paint = mix(paint, peel, smoothstep(0.945, 0.965, r));
  normal Nf = faceforward(normalize(N), I);
  normal wet = faceforward(normalize(calculatenormal(P + 0.008 * inside * cells * Nf)), I);
  vector V = -normalize(I);
  float Kr = polish(-V, wet, 1.4);
  Oi = Os;
  Ci = Os * (paint * received(Nf) + (0.4 + inside) * Kr * mirror(P, reflect(-V, wet), 0.12, 12));
}
