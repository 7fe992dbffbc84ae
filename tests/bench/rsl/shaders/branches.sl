surface branches(float Kd = .8, frequency = 6) {
  point Q = frequency * transform("shader", P);
  float n = noise(Q);
  color base;
  if (n < .4) {
    float m = noise(3 * Q);
    if (m < .5)
      base = color(.1, .3, .6) * (.5 + m);
    else
      base = color(.2, .5, .8) * sqrt(m);
  } else if (n < .55) {
    base = mix(color(.8, .7, .4), color(.4, .6, .2), smoothstep(.4, .55, n));
    if (ycomp(Q) > 0)
      base *= .8 + .4 * noise(8 * Q);
  } else {
    float height = (n - .55) * 4;
    if (height > .6)
      base = color(.95, .95, 1);
    else
      base = mix(color(.3, .5, .1), color(.5, .4, .3), height);
  }
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * base * (ambient() + Kd * diffuse(Nf));
}
