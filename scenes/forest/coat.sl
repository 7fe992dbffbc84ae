#include "forest.h"

/* The coat is brown hair, whose tips glow against the light. */
surface coat() {
  point q = transform("forest", P), p = transform("shader", P);
  normal Nn = normalize(N), Nf = faceforward(Nn, I);
  color hair = mix(color(0.20, 0.105, 0.05), color(0.11, 0.06, 0.03), smoothstep(-0.2, 0.5, snoise(3 * q)));
  hair = mix(hair, color(0.055, 0.032, 0.018), 1 - smoothstep(0.3, 0.55, ycomp(p)));
  hair = mix(hair, color(0.34, 0.27, 0.18), (1 - smoothstep(-0.66, -0.55, xcomp(p))) * smoothstep(0.75, 0.95, ycomp(p)));
  hair = mix(hair, color(0.20, 0.15, 0.10), smoothstep(1.74, 1.78, ycomp(p)));
  vector V = -normalize(I);
  /* The tips of hairs reach out of the shadow that the body casts on itself. */
  color rim = 0;
  illuminance (P + 0.07 * vector Nf, vector(0, 0, 1), PI)
    rim += Cl * 0.9 * pow(1 - abs(V . Nf), 2.2) * pow(max(0, 0.5 - 0.5 * (normalize(L) . V)), 2);
  Oi = Os;
  Ci = Os * (hair * (diffuse(Nf) + skylight(ntransform("forest", Nf), q)) + color(0.6, 0.42, 0.22) * rim);
}
