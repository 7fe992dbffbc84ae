/* A pane of the window: what it mirrors of the room lies over what is outside. */
surface pane() {
  vector In = normalize(I);
  normal Nf = faceforward(normalize(N), In);
  float Kr, Kt;
  fresnel(In, Nf, 1 / 1.52, Kr, Kt);
  /* Both faces of the glass mirror. */
  Kr = min(1, 2 * Kr);
  Oi = Kr;
  Ci = Kr * trace(P, reflect(In, Nf));
}
