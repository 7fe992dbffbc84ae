surface granite(float Kd = .8, frequency = 3) {
  point Q = frequency * transform("shader", P);
  float sum = 0, amplitude = 1, k;
  for (k = 0; k < 8; k += 1) {
    sum += amplitude * (noise(Q) - .5);
    Q *= 2.03;
    amplitude *= .6;
  }
  float grey = clamp(.5 + sum, 0, 1);
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * Cs * grey * (ambient() + Kd * diffuse(Nf));
}
