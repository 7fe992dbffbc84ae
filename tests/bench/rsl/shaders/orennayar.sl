surface orennayar(float roughness = .5) {
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  float sigma2 = roughness * roughness;
  float A = 1 - .5 * sigma2 / (sigma2 + .33), B = .45 * sigma2 / (sigma2 + .09);
  float thetar = acos(V . Nf);
  vector Vflat = normalize(V - Nf * (V . Nf));
  color sum = 0;
  illuminance(P, Nf, PI / 2) {
    vector Ln = normalize(L);
    float cosi = Ln . Nf, thetai = acos(cosi);
    float cosphi = Vflat . normalize(Ln - Nf * cosi);
    float alpha = max(thetar, thetai), beta = min(thetar, thetai);
    sum += Cl * cosi * (A + B * max(0, cosphi) * sin(alpha) * tan(beta));
  }
  Oi = Os;
  Ci = Os * Cs * (ambient() + sum);
}
