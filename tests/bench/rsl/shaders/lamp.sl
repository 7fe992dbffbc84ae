light lamp(float intensity = 30, coneangle = .5, conedeltaangle = .1, beamdistribution = 2; color lightcolor = (1, .9, .8);
           point from = point "current" (0, 0, 1), to = point "current" (0, 0, 5)) {
  uniform vector A = normalize(to - from);
  uniform float outer = cos(coneangle), inner = cos(coneangle - conedeltaangle);
  illuminate(from, A, coneangle) {
    float cosine = (L . A) / length(L);
    float falloff = pow(cosine, beamdistribution) / (L . L) * smoothstep(outer, inner, cosine);
    float stripes = .5 + .5 * sin(30 * xcomp(L) / zcomp(L));
    Cl = intensity * lightcolor * falloff * mix(.5, 1, stripes);
  }
}
