/* The surface of water reflects and refracts light by Fresnel's equations. It is opaque to shadow rays, because photons
 * bring the light that it lets through.
 */
surface water(float eta = 1.333) {
  vector In = normalize(I);
  normal Nn = normalize(N);
  float inside = (In . Nn > 0) ? 1 : 0;
  Oi = 1;
  Ci = 0;
  if (isshadowray() == 0 && isindirectray() == 0) {
    float Kr, Kt;
    vector R, T;
    fresnel(In, faceforward(Nn, In), inside == 1 ? eta : 1 / eta, Kr, Kt, R, T);
    /* A wave that faces the eye never mirrors what lies below the water. */
    if (Kr < 0.999) Ci = (1 - Kr) * trace(P, normalize(T));
    if (raydepth() == 0) Ci += Kr * trace(P, normalize(R));
  }
}
