surface cells(float Kd = .8, frequency = 6, jitter = .9) {
  point Q = frequency * transform("shader", P);
  point corner = point(floor(xcomp(Q)) + .5, floor(ycomp(Q)) + .5, floor(zcomp(Q)) + .5);
  float f1 = 1000, f2 = 1000, i, j, k;
  for (i = -1; i <= 1; i += 1)
    for (j = -1; j <= 1; j += 1)
      for (k = -1; k <= 1; k += 1) {
        point cell = corner + vector(i, j, k);
        point site = cell + jitter * (vector cellnoise(cell) - .5);
        vector offset = site - Q;
        float d = offset . offset;
        if (d < f1) {
          f2 = f1;
          f1 = d;
        } else if (d < f2)
          f2 = d;
      }
  float edge = smoothstep(.05, .15, sqrt(f2) - sqrt(f1));
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * mix(color(.1, .05, .05), Cs, edge) * (ambient() + Kd * diffuse(Nf));
}
