#include "noises.h"

/* The wood has rings around a trunk along z, and the fine grain of its fibres. */
surface wood(float Ka = 1, Kd = 0.9, Ks = 0.25, roughness = 0.12;
             float rings = 9, wobble = 0.12, grain = 0.35;
             color light = color(0.62, 0.36, 0.16), dark = color(0.28, 0.12, 0.045)) {
  point q = transform("shader", P);
  q += wobble * vsnoise(1.5 * point(xcomp(q), ycomp(q), 0.3 * zcomp(q)));
  float radius = rings * sqrt(xcomp(q) * xcomp(q) + ycomp(q) * ycomp(q));
  float width = filterwidth(radius);

  /* Each year adds light growth in spring and a sharp dark edge in autumn. Rings that are finer than a sample take
     their mean. */
  float year = mod(radius, 1);
  float late = smoothstep(0.35, 0.95, year) * (1 - smoothstep(0.95, 1, year));
  late = mix(late, 0.34, smoothstep(0.4, 1, width));
  late *= 0.7 + 0.6 * float cellnoise(floor(radius));

  float fibre = noise(60 * xcomp(q), 60 * ycomp(q) + 2 * zcomp(q));
  fibre = mix(fibre, 0.5, smoothstep(0.2, 0.7, 60 * sqrt(area(q))));
  color board = mix(light, dark, clamp(late, 0, 1)) * (1 - grain * (fibre - 0.5));

  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (board * (Ka * ambient() + Kd * diffuse(Nf)) +
             Ks * (1 - 0.5 * late) * specular(Nf, -normalize(I), roughness));
}
