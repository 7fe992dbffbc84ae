surface bumps(float Kd = .8, Ks = .4, roughness = .1, frequency = 8, height = .02) {
  vector Nn = normalize(N);
  float size = height * noise(frequency * transform("shader", P));
  vector du_ = dPdu + Nn * Du(size), dv_ = dPdv + Nn * Dv(size);
  normal Nf = faceforward(normalize(normal(dv_ ^ du_)), I);
  Oi = Os;
  Ci = Os * (Cs * (ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -normalize(I), roughness));
}
