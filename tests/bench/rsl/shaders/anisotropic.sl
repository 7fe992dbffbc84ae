surface anisotropic(float Kd = .4, Ks = .6, along = .1, across = .4) {
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I), X = normalize(dPdu), Y = Nf ^ X;
  color shine = 0, soft = 0;
  float cosr = V . Nf;
  illuminance(P, Nf, PI / 2) {
    vector Ln = normalize(L), H = normalize(V + Ln);
    float cosi = Ln . Nf;
    if (cosi > 0 && cosr > 0) {
      float x = (H . X) / along, y = (H . Y) / across;
      float rho = exp(-2 * (x * x + y * y) / (1 + H . Nf));
      shine += Cl * cosi * rho / (4 * PI * along * across * sqrt(cosi * cosr));
      soft += Cl * cosi;
    }
  }
  Oi = Os;
  Ci = Os * (Cs * (ambient() + Kd * soft) + Ks * shine);
}
