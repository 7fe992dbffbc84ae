#include "room.h"

/* A wool rug has a border, a field of lozenges, and the faded tones of plant dyes. */
surface rug(color field = color(0.165, 0.042, 0.032), border = color(0.055, 0.075, 0.12), thread = color(0.36, 0.26, 0.15)) {
  point q = transform("room", P);
  float width = filterwidthp(q), x = xcomp(q) - 0.1, z = zcomp(q) - 0.025;
  float away = min(1.8 - abs(x), 1.525 - abs(z));
  /* Each cell has a lozenge with a smaller one in it. */
  float a = x / 0.3, b = z / 0.3, name = cellnoise(a, b);
  float lozenge = abs(mod(a, 1) - 0.5) + abs(mod(b, 1) - 0.5), w = max(width / 0.3, 0.02);
  color wool = field;
  wool = mix(wool, thread, smoothstep(0.36, 0.36 + w, lozenge) - smoothstep(0.44, 0.44 + w, lozenge));
  wool = mix(wool, mix(border, thread, step(0.6, name)), 1 - smoothstep(0.18, 0.18 + w, lozenge));
  float edge = mod((abs(x) > 1.15 * abs(z) ? z : x) / 0.12, 1);
  color side = mix(border, mix(thread, field, 0.4), smoothstep(0.3, 0.34, abs(edge - 0.5) + 0.5 * abs(mod(away / 0.26, 1) - 0.5)));
  wool = mix(side, wool, smoothstep(0.26, 0.265 + width, away));
  float stripe = smoothstep(0.235, 0.24 + width, away) - smoothstep(0.26, 0.265 + width, away) + smoothstep(0.02, 0.025 + width, away) - smoothstep(0.05, 0.055 + width, away);
  wool = mix(wool, thread, clamp(stripe, 0, 1));
  float pile = fBm(point(260 * xcomp(q), 0, 130 * zcomp(q)), 260 * width, 2, 2, 0.6), faded = fBm(1.3 * q, 1.3 * width, 4, 2.1, 0.5);
  wool *= (1 + 0.35 * pile) * (1 + 0.3 * faded) * (0.9 + 0.2 * float noise(point(0, 0, 55 * zcomp(q))));
  normal Nf = faceforward(normalize(calculatenormal(P + 0.0018 * (pile + snoise(22 * q)) * normalize(N))), I);
  Oi = Os;
  Ci = Os * wool * received(Nf);
}
