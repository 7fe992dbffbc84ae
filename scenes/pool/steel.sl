/* This is polished steel. */
surface steel() {
  vector In = normalize(I);
  normal Nf = faceforward(normalize(N), In);
  Oi = Os;
  Ci = Os * mix(Cs, color(1), pow(1 - abs(In . Nf), 5)) * trace(P, reflect(In, Nf));
}
