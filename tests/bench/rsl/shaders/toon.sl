surface toon(float tones = 3, outline = 2; color inkcolor = 0) {
  normal Nf = faceforward(normalize(N), I);
  float light = 0;
  illuminance(P, Nf, PI / 2) light += .3333 * (comp(Cl, 0) + comp(Cl, 1) + comp(Cl, 2)) * (normalize(L) . Nf);
  float tone = floor(light * tones + .5) / tones;
  float facing = -normalize(I) . Nf;
  float ink = 1 - smoothstep(.2, .25, facing);
  Oi = Os;
  Ci = Os * mix(Cs * (ambient() + tone), inkcolor, ink);
}
