#include "forest.h"

/* A beech has smooth grey bark. Cracks run around it, pale lichen grows on it, and moss covers its foot. */
surface bark(float old = 1) {
  point q = transform("forest", P);
  float width = filterwidthp(q);
  point around = point(3 * xcomp(q), 9 * ycomp(q), 3 * zcomp(q));
  float rough = fBm(around * 2, 6 * width, 4, 2.1, 0.6), wide = fBm(q * 1.3, 1.3 * width, 4, 2.1, 0.55);
  float crack = smoothstep(0.80, 0.97, 1 - abs(fBm(point(xcomp(q), 3.2 * ycomp(q), zcomp(q)) * 2.3, 5 * width, 3, 2.2, 0.6)));
  float lichen = smoothstep(0.12, 0.35, fBm(q * 4.5, 4.5 * width, 4, 2.2, 0.6));
  float height = ycomp(q) - 0.4;
  float moss = old * smoothstep(0.1, 0.5, 0.55 * exp(-height / 0.9) + 0.45 * wide + 0.25 * rough - 0.05 * height);
  normal Nn = normalize(N), Nb = Nn;
  if (old > 0)
    Nb = normalize(calculatenormal(P + Nn * (0.0045 * rough - 0.006 * crack + 0.02 * wide + 0.014 * moss * fBm(q * 22, 22 * width, 3, 2, 0.6))));
  if (Nb . Nn < 0)
    Nb = -Nb;
  normal Nf = faceforward(Nb, I, Nn);
  color tint = mix(color(0.16, 0.145, 0.12), color(0.30, 0.285, 0.25), clamp(0.5 + wide + 0.4 * rough, 0, 1));
  tint = mix(tint, color(0.36, 0.39, 0.33), 0.55 * lichen) * (1 - 0.35 * crack);
  tint = mix(tint, color(0.085, 0.115, 0.022) * (1 + 0.8 * rough), moss);
  if (old == 0)
    tint *= 0.45;
  color rim = 0;
  vector V = -normalize(I);
  illuminance (P, Nf, PI / 2) rim += Cl * 0.25 * pow(1 - max(0, V . Nf), 4) * moss;
  Oi = Os;
  Ci = Os * (tint * (diffuse(Nf) + skylight(ntransform("forest", Nf), q)) + color(0.5, 0.6, 0.2) * rim);
}
