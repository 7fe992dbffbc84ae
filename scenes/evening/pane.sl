/* The glass of a window adds the reflected room to the view of the outside. */
surface pane() {
  vector In = normalize(I);
  normal Nf = faceforward(normalize(N), In);
  float Kr, Kt;
  fresnel(In, Nf, 1 / 1.52, Kr, Kt);
  /* Both faces of the glass reflect. */
  Kr = min(1, 2 * Kr);
  Oi = Kr;
  Ci = Kr * trace(P, reflect(In, Nf));
}
