surface clouds(float frequency = 2, octaves = 6, threshold = .45, sharpness = 6; color sky = (.3, .5, .9)) {
  point Q = frequency * transform("shader", P);
  float sum = 0, amplitude = .5, k;
  for (k = 0; k < octaves; k += 1) {
    sum += amplitude * noise(Q);
    Q = 2 * Q + vector(.7, .3, .1);
    amplitude *= .5;
  }
  float cover = 1 - exp(-sharpness * max(sum - threshold, 0));
  float shade = pow(clamp(1 - sum, 0, 1), 1.5);
  Oi = Os;
  Ci = Os * mix(sky, mix(color(1, 1, 1), color(.5, .5, .55), shade), cover);
}
