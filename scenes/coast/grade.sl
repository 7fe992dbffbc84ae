/* This imager grades the picture like film. Its curve has a soft shoulder. Lights become a little warmer, shadows a
 * little bluer, and the corners darker.
 */
imager grade(float exposure = 1.2, contrast = 1.2, vignette = 0.28) {
  color c = exposure * Ci;
  /* Values above white are compressed gently, each channel by itself. */
  c = c * (1 + c / 9) / (1 + 0.62 * c);
  float grey = 0.2126 * comp(c, 0) + 0.7152 * comp(c, 1) + 0.0722 * comp(c, 2);
  float tone = clamp(grey, 0, 1);
  c = 0.18 * pow(max(c, color(0)) / 0.18, contrast);
  c *= mix(color(0.93, 0.98, 1.10), color(1.05, 1.0, 0.92), smoothstep(0.02, 0.45, tone));
  float x = 2 * u - 1, y = 2 * v - 1;
  Ci = c * (1 - vignette * smoothstep(0.6, 1.9, x * x + y * y));
}
