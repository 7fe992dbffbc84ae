#include "noon.h"

/* This shader draws the paint, the glass, the seams and the grille on the one smooth body of a car. Points are in the
 * space of the car. Its units are metres, x points to its left, y up and z forwards. The windows lie between two
 * slanted pillars: `front` and `back` hold their z at the belt and at the roof.
 */
surface carbody(float belt = 0.94, roof = 1.40, flake = 0; vector front = vector(0.98, 0.36, 0), back = vector(-1.42, -0.80, 0);
                float middle = -0.22, panel = 0; float wheelfront = 1.32, wheelback = -1.28) {
  point q = transform("shader", P);
  normal Nf = faceforward(normalize(N), I), n = normalize(ntransform("shader", Nf));
  float x = abs(xcomp(q)), y = ycomp(q), z = zcomp(q), soft = max(filterwidthp(q), 0.001);
  float rise = clamp((y - belt) / (roof - belt), 0, 1);
  float a = mix(xcomp(front), ycomp(front), rise), c = mix(xcomp(back), ycomp(back), rise);
  float sideways = smoothstep(0.40, 0.55, abs(xcomp(n)));
  float pane = between(y, belt + 0.055, roof - 0.065, soft);
  float side = sideways * pane * between(z, c + 0.15, a - 0.13, soft) * (1 - stroke(z, middle, 0.09, soft));
  if (panel > 0) side *= smoothstep(middle - 0.5 * soft, middle + 0.5 * soft, z);
  float ends = (1 - sideways) * between(y, belt + 0.075, roof - 0.055, soft) * between(x, -1, 0.70 - 0.14 * rise, soft) *
               max(smoothstep(a - 0.20, a - 0.16, z), panel > 0 ? 0 : 1 - smoothstep(c + 0.16, c + 0.20, z));
  float glass = max(side, ends);

  color tint = Cs;
  float clean = 1;
  if (isindirectray() == 0) {
    /* Doors, hood and trunk have seams, the glass has rubber around it, and the wheel arches and the grille are dark.
     */
    float flank = smoothstep(0.5, 0.7, abs(xcomp(n))) * between(y, 0.30, belt + 0.02, soft);
    float seam = flank * max(stroke(z, xcomp(front) - 0.12, 0.009, soft), max(stroke(z, middle - 0.02, 0.009, soft), stroke(z, xcomp(back) + 0.30, 0.009, soft)));
    float top = smoothstep(0.6, 0.8, ycomp(n)) * (1 - pane);
    seam = max(seam, top * (z > 0 ? 1 : 0) * stroke(x, 0.70 - 0.05 * z, 0.009, soft));
    seam = max(seam, smoothstep(0.3, 0.5, zcomp(n)) * 0.9 * stroke(y, 0.735, 0.010, soft) * between(x, -1, 0.62, soft));
    float arch = max(1 - smoothstep(0.385, 0.392 + soft, sqrt(pow(z - wheelfront, 2) + pow(y - 0.32, 2))),
                     1 - smoothstep(0.385, 0.392 + soft, sqrt(pow(z - wheelback, 2) + pow(y - 0.32, 2))));
    float lip = sideways * between(y, belt + 0.02, roof - 0.03, soft) * between(z, c + 0.10, a - 0.09, soft);
    float grille = smoothstep(0.45, 0.6, zcomp(n)) * between(y, 0.50, 0.64, soft) * between(x, -1, 0.44, soft);
    grille = max(grille, smoothstep(0.45, 0.6, zcomp(n)) * between(y, 0.28, 0.37, soft) * between(x, -1, 0.55, soft));
    float bars = mix(0.5, smoothstep(-0.3, 0.3, sin(2 * PI * y / 0.028)), 1 - smoothstep(0.008, 0.02, soft));
    tint = mix(tint, color(0.02, 0.02, 0.02), max(0.85 * seam, max(arch * (x > 0.55 ? 1 : 0), max(0.93 * lip, grille * (1 - 0.35 * bars)))));
    tint = mix(tint, color(0.025, 0.025, 0.025), 1 - smoothstep(0.24, 0.27, y));
    clean = 1 - max(arch, max(0.7 * grille, seam));
    tint *= mix(color(0.80, 0.77, 0.72), color(1, 1, 1), smoothstep(0.2, 0.6, y + 0.1 * snoise(3 * q)));
  }
  Oi = Os;
  Ci = Os * tint * received(Nf, isindirectray() + raydepth());
  if (isindirectray() == 0) {
    color coat = mirrored(Nf, mix(1.5, 1.75, flake), 0.025, 32);
    /* The lacquer reflects the sun itself. */
    vector V = -normalize(I);
    color glint = 0;
    illuminance ("sun", P, Nf, PI / 2) glint += Cl * (1.6 * pow(max(0, normalize(normalize(L) + V) . Nf), 900) + (0.02 + 0.12 * flake) * pow(max(0, normalize(normalize(L) + V) . Nf), 40));
    color cabin = mix(color(0.010, 0.011, 0.012), color(0.05, 0.048, 0.045), (1 - smoothstep(0.2, 0.75, rise)) * (0.5 + 0.5 * float noise(4 * q)));
    Ci = mix(Ci + (coat + glint) * clean, cabin + 1.1 * mirrored(Nf, 1.6, 0.01, 8) + glint, glass);
  }
}
