#include "forest.h"

/* A leaf of a beech is cut out of a square. The sun shines through a leaf on the tree, and a fallen leaf is copper. */
surface beech(float fallen = 0; float which = 0.5) {
  float across = abs(2 * s - 1), width = 0.92 * pow(max(0, sin(PI * pow(clamp((t - 0.1) / 0.9, 0, 1), 0.8))), 0.75) + 0.02 * sin(70 * t);
  float inside = max(width - across, (t < 0.2 ? 0.06 : 0) - across);
  float soft = max(filterwidth(inside), 0.001);
  float cut = smoothstep(-0.5 * soft, 0.5 * soft, inside);

  point q = transform("forest", P);
  float tone = which + 0.35 * snoise(q * 0.6);
  color green = mix(color(0.16, 0.24, 0.035), color(0.42, 0.36, 0.045), smoothstep(0.15, 0.75, tone));
  color gold = mix(green, color(0.66, 0.34, 0.04), smoothstep(0.6, 1.0, tone));
  color dead = mix(color(0.30, 0.115, 0.035), color(0.52, 0.27, 0.09), which) * (0.7 + 0.6 * float cellnoise(9 * which + 3));
  float vein = pow(abs(sin(PI * (9 * t - 4 * across))), 12);
  color tint = mix(gold, dead, fallen) * (1 - 0.3 * vein) * (1 + 0.25 * snoise(60 * q));

  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  color before = 0, through = 0;
  illuminance (P, vector(0, 0, 1), PI) {
    float facing = normalize(L) . Nf;
    if (facing > 0)
      before += Cl * (0.6 * facing + 0.14 * pow(max(0, normalize(normalize(L) + V) . Nf), 24));
    else
      through += Cl * (-0.75 * facing + 0.12);
  }
  color light = skylight(ntransform("forest", Nf), q);
  Oi = Os * cut;
  Ci = Oi * (tint * (before + light) + (1 - 0.7 * fallen) * pow(tint, 0.8) * (through + 0.35 * light));
}
