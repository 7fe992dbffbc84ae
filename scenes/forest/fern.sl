#include "forest.h"

/* A frond is cut out of a strip that is three points wide. v runs along its rib, and u across it. */
surface fern(float pairs = 23) {
  float across = abs(2 * u - 1), width = sin(PI * pow(v, 0.55)) * (1 - 0.3 * v);
  width = min(1, 1.15 * width * smoothstep(0.06, 0.2, v));
  /* Each pinna (a leaflet of the frond) tapers to its tip and has small lobes. */
  float row = pairs * v - 2.6 * across, reach = clamp(across / max(width, 0.01), 0, 1.2);
  float half = 0.47 * pow(max(0, 1 - reach), 0.6) * (0.86 + 0.14 * sin(52 * across));
  float inside = half - abs(mod(row, 1) - 0.5);
  float rib = 0.035 * (1 - v) + 0.006 - across;
  float soft = max(filterwidth(row), 0.01), softrib = max(filterwidth(across), 0.003);
  float cut = max(smoothstep(-0.5 * soft, 0.5 * soft, inside) * (1 - step(1, reach)), smoothstep(-0.5 * softrib, 0.5 * softrib, rib));

  point q = transform("forest", P);
  float dry = smoothstep(0.35, 0.75, float noise(q * 0.7 + vector(3, 1, 4)) + 0.25 * v);
  color tint = mix(color(0.085, 0.17, 0.03), color(0.40, 0.22, 0.05), 0.8 * dry) * (0.75 + 0.5 * float cellnoise(floor(row) + 31 * ycomp(q)));
  normal Nf = faceforward(normalize(N), I);
  color before = 0, through = 0;
  illuminance (P, vector(0, 0, 1), PI) {
    float facing = normalize(L) . Nf;
    before += Cl * max(0, facing);
    through += Cl * max(0, -facing);
  }
  color light = skylight(ntransform("forest", Nf), q);
  Oi = Os * cut;
  Ci = Oi * (tint * (0.7 * before + light) + pow(tint, 0.8) * (0.7 * through + 0.3 * light));
}
