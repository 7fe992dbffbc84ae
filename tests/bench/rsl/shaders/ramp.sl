surface ramp(float frequency = 3) {
  point Q = frequency * transform("shader", P);
  float n = noise(Q);
  color base = spline(n, color(0, 0, .2), color(0, 0, .2), color(0, .2, .6), color(.2, .6, .6), color(.8, .8, .3),
                      color(.9, .4, .1), color(.5, .05, 0), color(.2, 0, 0), color(.2, 0, 0));
  float bright = spline(noise(2 * Q), .4, .4, .6, 1, 1.2, 1.2);
  Oi = Os;
  Ci = Os * base * bright;
}
