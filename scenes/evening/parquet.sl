#include "room.h"

/* Returns how much of a pixel lies on a joint, which extends from -wide to wide around 0. */
float onjoint(float x, wide, pixel) {
  return max(0, min(x + 0.5 * pixel, wide) - max(x - 0.5 * pixel, -wide)) / pixel;
}

/* The floor is oak in a herringbone pattern, oiled and worn. */
surface parquet(color pale = color(0.30, 0.165, 0.075), dark = color(0.13, 0.06, 0.025); float wide = 0.09, pieces = 5;) {
  point q = transform("room", P);
  float a = (xcomp(q) + zcomp(q)) / (1.41421 * wide), b = (zcomp(q) - xcomp(q)) / (1.41421 * wide);
  /* Blocks alternate between lying along a and lying along b. The whole numbers below a and b tell which block covers a
   * place.
   */
  float row = floor(a), column = floor(b), turn = mod(row - column, 2 * pieces);
  float along = turn < pieces ? a - row + turn : b - column + 2 * pieces - 1 - turn;
  float across = turn < pieces ? b - column : a - row;
  float name = turn < pieces ? cellnoise(column, row - turn) : cellnoise(column - (2 * pieces - 1 - turn) + 91, row);
  float width = filterwidthp(q) / wide;
  point g = point(0.35 * along + 19 * name, 3 * name, across + 7 * name);
  float fibre = fBm(point(3 * xcomp(g), 0, 16 * zcomp(g)), 16 * width, 4, 2, 0.55);
  float year = 0.5 + 0.5 * sin(2 * PI * (2.2 * zcomp(g) + 1.2 * snoise(g * 1.3)));
  color wood = mix(pale, dark, clamp(0.2 + 0.3 * year + 0.4 * fibre + 0.8 * (name - 0.5), 0, 1));
  float da = max(filterwidth(a), 0.01), db = max(filterwidth(b), 0.01);
  float joint = max(onjoint(min(across, 1 - across), 0.02, turn < pieces ? db : da), onjoint(min(along, pieces - along), 0.02, turn < pieces ? da : db));
  wood *= 1 - 0.7 * joint;
  normal Nf = faceforward(normalize(N), I);
  normal grained = faceforward(normalize(calculatenormal(P - 0.0006 * (fibre + 0.8 * (name - 0.5) * across) * normalize(N))), I);
  /* The grain of one block does not continue in the next one, so a slope that spans two blocks means nothing. */
  float edge = min(min(across, 1 - across), min(along, pieces - along));
  Nf = normalize(Nf + (grained - Nf) * smoothstep(1, 2, edge / max(da, db)));
  float worn = 0.5 + 0.5 * fBm(1.1 * q, 1.1 * filterwidthp(q), 4, 2.1, 0.5);
  Oi = Os;
  Ci = Os * (wood * received(normalize(N)) + mix(0.95, 0.5, worn) * (1 - joint) * gloss(Nf, 1.45, 0.10, 16));
}
