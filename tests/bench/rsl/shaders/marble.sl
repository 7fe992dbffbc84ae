surface marble(float Kd = .8, Ks = .4, roughness = .07, frequency = 4) {
  point Q = frequency * transform("shader", P);
  float turbulence = 0, size = 1, k;
  for (k = 0; k < 6; k += 1) {
    turbulence += abs(2 * noise(Q * size) - 1) / size;
    size *= 2;
  }
  float vein = clamp(.5 + .5 * sin(xcomp(Q) + 5 * turbulence), 0, 1);
  color base = spline(vein, color(.2, .2, .3), color(.2, .2, .3), color(.5, .5, .6), color(.8, .8, .85),
                      color(.9, .9, .9), color(.9, .9, .9));
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (base * (ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -normalize(I), roughness));
}
