/* A candle's flame is blue and clear at the wick, and yellow and white above. It is thin at its rim. */
surface flame(float brightness = 1.9) {
  point q = transform("shader", P);
  float y = ycomp(q) / 0.56, core = abs(normalize(N) . normalize(I));
  color fire = mix(color(1, 0.36, 0.07), color(1, 0.80, 0.42), smoothstep(0.1, 0.8, core));
  fire = mix(color(0.10, 0.16, 0.5), fire, smoothstep(0.05, 0.35, y));
  float body = smoothstep(0.0, 0.55, core) * smoothstep(-0.05, 0.3, y);
  Oi = 0.5 * body;
  Ci = brightness * body * fire;
}
