surface march(float steps = 24, frequency = 2, density = 8) {
  point Q = frequency * transform("shader", P);
  vector way = .1 * normalize(vtransform("shader", I));
  float clear = 1, light = 0, k;
  for (k = 0; k < steps; k += 1) {
    if (clear < .05)
      break;
    float d = density * max(noise(Q) - .5, 0);
    if (d > 0) {
      float seen = exp(-.1 * d);
      light += clear * (1 - seen) * (.5 + .5 * ycomp(Q));
      clear *= seen;
    }
    Q += way;
  }
  Oi = Os;
  Ci = Os * mix(color(light, light, light), Cs, clear);
}
