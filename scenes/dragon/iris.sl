#include "dragon.h"

/* An eye has fibres around a slit and a dark rim. Its wet cornea reflects a window. */
surface iris() {
  point q = transform("face", P);
  point e = eyespace(xcomp(q), ycomp(q));
  float ex = xcomp(e) + 0.05, ey = ycomp(e);
  float d = sqrt(ex * ex + ey * ey), angle = atan(ey, ex);
  float wave = 0.05 * snoise(point(3 * ey, 1, 2));
  float slit = (abs(ex) - 0.20 * pow(max(0, 1 - ey * ey / 1.25), 0.8) - 0.02 * wave);

  /* Fibres run outwards and fork. A ring of them frays around the pupil. */
  float away = max(0, d - 0.1);
  float fine = fBm(point(9 * cos(angle), 9 * sin(angle), 1.3 * away), 0, 5, 2.2, 0.65);
  float knots = fBm(point(3 * cos(angle), 3 * sin(angle), 2.2 * away + 7), 0, 4, 2.1, 0.6);
  color tint = mix(color(0.26, 0.055, 0.004), color(0.95, 0.42, 0.035), clamp(0.45 + 0.9 * fine + 0.5 * knots, 0, 1));
  tint = mix(tint, color(1.0, 0.72, 0.16), (1 - smoothstep(0.02, 0.35, slit)) * clamp(0.6 + fine, 0, 1));
  tint = mix(tint, color(0.16, 0.20, 0.04), 0.6 * smoothstep(0.55, 1.15, d + 0.3 * knots));
  tint *= 1 - 0.9 * smoothstep(1.05, 1.38, d + 0.06 * fine);
  tint *= smoothstep(0, 0.05, slit + 0.03 * fine);

  /* The lids cast a soft shadow. */
  float inside = opening(e);
  float shade = smoothstep(0.0, 0.55, inside - 0.12 * smoothstep(0, 0.6, ey));
  normal Nn = normalize(N), Nf = faceforward(Nn, I);
  vector V = -normalize(I);
  /* The iris is flatter than the cornea in front of it. */
  normal flatter = normalize(Nf - 2.5 * vtransform("face", "current", vector(0, 0, 1)));
  color light = 0;
  illuminance (P, flatter, PI / 2) light += Cl * (0.25 + 0.75 * (normalize(L) . flatter));

  vector R = normalize(vtransform("face", reflect(-V, Nf)));
  /* The cornea reflects a window with four panes, up and to the left, and the ground below. */
  float wx = (xcomp(R) + 0.52) / 0.17, wy = (ycomp(R) - 0.46) / 0.20;
  float pane = (1 - smoothstep(0.94, 1.02, max(abs(wx), abs(wy)))) * smoothstep(0.05, 0.10, min(abs(wx), abs(wy)));
  float edgewise = pow(1 - max(0, Nf . V), 5);
  color mirrored = pane * color(26, 28, 30) + mix(color(0.05, 0.04, 0.03), color(0.5, 0.62, 0.8), smoothstep(0.15, 0.8, ycomp(R)));
  float tear = exp(-pow((inside - 0.05) / 0.035, 2)) * step(ey, 0);
  Oi = Os;
  Ci = Os * (tint * shade * (0.72 * light + color(0.10, 0.11, 0.12)) + (0.045 + 0.6 * edgewise) * mirrored * (0.25 + 0.75 * shade) + 0.5 * tear * color(0.5, 0.55, 0.6));
}
