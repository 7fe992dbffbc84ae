/* This displacement makes the dents of a lemon's peel. */
displacement peel(float depth = 0.004, frequency = 30) {
  point q = transform("shader", P);
  float dent = smoothstep(0.35, 0.8, float noise(q * frequency));
  P -= depth * dent * normalize(N);
  N = calculatenormal(P);
}
