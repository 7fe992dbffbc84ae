#include "dragon.h"

/* This displacement raises the flat sheet to a face, and the face to scales. */
displacement scaly(float high = 0.42) {
  float x = SHEETX(u), y = SHEETY(v);
  vector near = vtransform("face", "current", vector(0, 0, -1));
  float outer = sign(calculatenormal(P) . near);
  P += face(x, y) * near;
  vector n = outer * normalize(calculatenormal(P));

  float edge = 0, middle = 0, which = 0, size = 0;
  vector tilt = 0;
  scales(x, y, edge, middle, which, size, tilt);
  float out = 1 - smoothstep(-0.30, -0.10, opening(eyespace(x, y)));
  float dome = smoothstep(0, 0.30, edge) * (1 - 0.55 * middle * middle) * (0.75 + 0.5 * which);
  /* Each scale lies a little over the next one outwards. It has a keel and is worn. */
  float lean = 0.30 * zcomp(tilt) * smoothstep(0.02, 0.2, edge);
  point q = point(x, y, 10 * which);
  float worn = 0.10 * turbulence(q * (1.4 / size), 0, 3, 2.1, 0.55) + 0.05 * snoise(q * (5 / size));
  P += length(near) * high * size * (dome + lean - worn * smoothstep(0.05, 0.2, edge)) * (0.12 + 0.88 * out) * n;
  N = outer * calculatenormal(P);
}
