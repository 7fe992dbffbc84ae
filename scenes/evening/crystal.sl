/* Clear glass or wine reflects and refracts light by Fresnel's equations. Shadow rays go straight on instead. They take
 * the tint, and lose more of their light near the rim.
 */
surface crystal(float eta = 1.52; color tint = color(0.985, 0.99, 0.985);) {
  vector In = normalize(I);
  normal Nn = normalize(N);
  float inside = (In . Nn > 0) ? 1 : 0;
  normal Nf = faceforward(Nn, In);
  if (isshadowray() == 1) {
    Oi = 1 - tint * mix(0.93, 0.45, pow(1 - abs(In . Nn), 3));
    Ci = 0;
  } else if (isindirectray() == 1) {
    Oi = 1 - tint;
    Ci = 0;
  } else {
    float Kr, Kt;
    vector R, T;
    fresnel(In, Nf, inside == 1 ? eta : 1 / eta, Kr, Kt, R, T);
    color through = 0;
    if (Kr < 0.999) through = (1 - Kr) * trace(P, normalize(T));
    color mirrored = 0;
    /* Two rays at every surface would double the number of rays each time. Behind the first surface, only directions
     * that reflect much get a ray of their own.
     */
    if (Kr > (raydepth() == 0 ? 0 : 0.3)) mirrored = Kr * trace(P, normalize(R));
    Oi = 1;
    Ci = (inside == 1 ? tint : color(1)) * through + mirrored;
  }
}
