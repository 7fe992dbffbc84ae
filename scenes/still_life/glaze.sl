#include "room.h"

/* Stoneware has a body and a second glaze that has run down over it, speckled with iron. A clear coat over both
 * reflects the room.
 */
surface glaze(float top = 4, dripheight = 0.42; color drip = color(0.74, 0.66, 0.50);) {
  point q = transform("shader", P);
  float width = filterwidthp(q), y = ycomp(q) / top;
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);

  /* The second glaze has stopped running here. It is thin at its edge, so the body shows through. */
  float angle = atan(xcomp(q), zcomp(q));
  float edge = dripheight + 0.09 * snoise(point(3 * sin(angle), 3 * cos(angle), 2)) + 0.05 * snoise(point(9 * sin(angle), 9 * cos(angle), 0.6 * y));
  float covered = smoothstep(-0.012, 0.03, y - edge), thin = 1 - smoothstep(0.0, 0.16, abs(y - edge));
  float flow = fBm(point(5 * xcomp(q), 1.1 * ycomp(q), 5 * zcomp(q)), 5 * width, 5, 2.1, 0.55);
  color body = Cs * (1 + 0.5 * flow), over = drip * (1 + 0.16 * flow);
  color paint = mix(body, over, covered);
  paint = mix(paint, color(0.20, 0.09, 0.035), 0.75 * thin * covered + 0.25 * thin);
  float iron = smoothstep(0.66, 0.80, float noise(q * 14)) * noisefade(14 * width);
  paint = mix(paint, color(0.07, 0.035, 0.02), 0.7 * iron * covered);

  normal coat = faceforward(normalize(calculatenormal(P + 0.006 * fBm(q * 2.2, 2.2 * width, 2, 2, 0.5) * normalize(N))), I);
  float Kr = polish(-V, coat, 1.55);
  color mirrored = mirror(P, reflect(-V, coat), 0.02, 6);
  Oi = Os;
  Ci = Os * (paint * received(Nf) * (1 - Kr) + Kr * mirrored);
}
