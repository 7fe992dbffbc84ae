#include "dragon.h"

/* Horn covers the skin: green and blue scales with pale edges, amber ones around the eye. They are polished. Light that
 * enters thin places comes out redder.
 */
surface skin(color deep = color(0.008, 0.036, 0.032), pale = color(0.055, 0.16, 0.085), warm = color(0.36, 0.13, 0.018)) {
  float x = SHEETX(u), y = SHEETY(v);
  float edge = 0, middle = 0, which = 0, size = 0;
  vector tilt = 0;
  scales(x, y, edge, middle, which, size, tilt);
  point e = eyespace(x, y), q = point(x, y, 0);
  float d = length(vector e), inside = opening(e);

  float patches = fBm(q / 2.6 + vector(3, 3, 3), 0, 4, 2.1, 0.55), grain = fBm(q * 9, 9 * filterwidthp(q), 4, 2.2, 0.6);
  color tint = mix(deep, pale, clamp(0.35 + 0.75 * patches + 0.7 * (which - 0.5), 0, 1));
  float amber = exp(-pow((d - 2.0) / 0.8, 2)) + 0.65 * smoothstep(0.25, 0.6, patches + 0.35 * (which - 0.5));
  tint = mix(tint, warm * (0.6 + 0.8 * which), clamp(amber, 0, 0.9));
  tint *= (1 + 0.5 * grain) * mix(0.75, 1.25, step(0.5, middle));
  tint = mix(tint, tint * 1.6 + color(0.03, 0.03, 0.02), smoothstep(0.10, 0.25, edge) * (1 - smoothstep(0.25, 0.45, edge)) * 0.5);
  float groove = smoothstep(0.0, 0.16, edge);
  tint = mix(color(0.028, 0.018, 0.012), tint, groove);
  float lid = smoothstep(-0.26, -0.08, inside);
  tint = mix(tint, color(0.045, 0.022, 0.018), lid);

  normal Nn = normalize(N), Nf = faceforward(Nn, I);
  vector V = -normalize(I);
  float open = mix(0.35, 1, groove) * (1 - 0.55 * smoothstep(0, 0.05, inside));
  color light = 0, shine = 0;
  float rough = mix(0.27, 0.12, lid);
  illuminance (P, Nf, PI / 2) {
    vector L1 = normalize(L), H = normalize(L1 + V);
    light += Cl * (L1 . Nf);
    float facing = max(0, H . Nf);
    shine += Cl * exp(-(1 - facing * facing) / (facing * facing * rough * rough)) * 0.022 / (rough * rough) * (0.6 + 0.8 * float noise(q * 30));
  }
  normal n = ntransform("face", Nf);
  vector R = vtransform("face", reflect(-V, Nf));
  float edgewise = pow(1 - max(0, Nf . V), 4);
  color sky = mix(color(0.05, 0.045, 0.04), color(0.16, 0.24, 0.34), 0.5 + 0.5 * ycomp(n));
  color mirrored = mix(color(0.03, 0.03, 0.03), color(0.30, 0.42, 0.55), smoothstep(-0.1, 0.6, ycomp(R)));
  Oi = Os;
  Ci = Os * open * (tint * (light + sky) + shine * (0.4 + 0.6 * groove) + (0.035 + 0.35 * edgewise) * mirrored);
}
