#include "room.h"

/* Boards of oiled oak lie along x. Each has its own tone and grain, and wear has given it a different shine from place
 * to place.
 */
surface oak(color pale = color(0.36, 0.20, 0.095), dark = color(0.13, 0.06, 0.026); float boards = 0.55, shine = 0.5;) {
  point q = transform("room", P);
  float row = floor(boards * zcomp(q)), across = mod(boards * zcomp(q), 1);
  float tone = cellnoise(row + 0.5);
  point g = point(0.09 * xcomp(q) + 7 * tone, ycomp(q), zcomp(q) + 3 * tone);
  g += vector(0, 0, 0.25 * snoise(g * 1.5));
  float width = filterwidthp(q);
  /* Growth rings are stretched along the board. Pores are short dark strokes in them. */
  float year = 0.5 + 0.5 * sin(2 * PI * (5 * zcomp(g) + 2.5 * snoise(g * 1.1)));
  float fibre = fBm(point(3 * xcomp(g), 0, 22 * zcomp(g)), 22 * width, 4, 2, 0.55);
  float pores = smoothstep(0.62, 0.85, float noise(point(28 * xcomp(g), 0, 75 * zcomp(g)))) * noisefade(40 * width);
  float mixture = clamp(0.25 + 0.4 * year * year + 0.35 * fibre + 0.6 * (tone - 0.5), 0, 1);
  color wood = mix(pale, dark, mixture) * (1 - 0.55 * pores);
  float joint = smoothstep(0.0, 0.022, across) * (1 - smoothstep(0.978, 1, across));
  wood *= mix(0.18, 1, joint);

  point moved = P - 0.004 * (fibre + 2 * pores + 3 * (1 - joint)) * normalize(N);
  normal Nf = faceforward(normalize(calculatenormal(moved)), I);
  vector V = -normalize(I);
  float worn = 0.5 + 0.5 * fBm(q * 0.8, 0.8 * width, 4, 2.1, 0.5);
  float Kr = polish(-V, Nf, 1.45);
  color mirrored = mirror(P, reflect(-V, Nf), 0.12, 12);
  Oi = Os;
  Ci = Os * (wood * received(Nf) + shine * joint * mix(1.3, 0.6, worn) * Kr * mirrored);
}
