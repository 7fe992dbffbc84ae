/* Ruby reflects and refracts light by Fresnel's equations, and tints the light that it refracts. */
surface ruby(float eta = 1.77; color tint = color(0.88, 0.09, 0.19);) {
  vector In = normalize(I);
  normal Nn = normalize(N);
  float inside = (In . Nn > 0) ? 1 : 0, Kr, Kt;
  vector R, T;
  fresnel(In, faceforward(Nn, In), inside == 1 ? eta : 1 / eta, Kr, Kt, R, T);
  color through = color(0.12, 0.006, 0.02), mirrored = 0;
  if (raydepth() == 0) {
    through += (1 - Kr) * tint * trace(P, normalize(T), "samplecone", 0.03, "samples", 32);
    mirrored = Kr * trace(P, normalize(R), "samplecone", 0.05, "samples", 32);
  } else if (Kr < 0.999 && raydepth() < 4)
    through += (1 - Kr) * tint * trace(P, normalize(T));
  Oi = Os;
  Ci = Os * (through + mirrored);
}
