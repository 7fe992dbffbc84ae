/* This displacement raises still water to small waves in all directions. Their lengths range from a hand's width to a
 * metre, and all have the same slope.
 */
displacement waves(float slope = 0.02, shortest = 0.16, longest = 1.1) {
  point q = transform("court", P);
  vector up = vtransform("court", "current", vector(0, 1, 0));
  float x = xcomp(q), z = zcomp(q), y = 0;
  x += 0.10 * (float noise(1.1 * x, 1.1 * z) - 0.5);
  z += 0.10 * (float noise(1.1 * x + 7, 1.1 * z + 3) - 0.5);
  uniform float k, waves = 26;
  for (k = 0; k < waves; k += 1) {
    uniform float number = 2 * PI / (shortest * pow(longest / shortest, k / (waves - 1)));
    uniform float angle = 2.39996 * k + 0.3;
    y += slope / number * sin(number * (x * cos(angle) + z * sin(angle)) + 5.3 * k);
  }
  float outer = sign(calculatenormal(P) . up);
  P += y * up;
  N = outer * calculatenormal(P);
}
