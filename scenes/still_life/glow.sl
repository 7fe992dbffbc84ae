/* This is the light that the eye itself scatters around a flame. */
surface glow(color warm = color(1.0, 0.50, 0.17); float brightness = 0.35;) {
  Oi = 0;
  Ci = brightness * warm * pow(max(0, v), 3);
}
