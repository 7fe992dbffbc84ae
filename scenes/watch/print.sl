/* This imager grades the picture like a photographic print. Bright parts run out softly, contrast grows, shadows become
 * cooler and lights warmer, and the corners become darker.
 */
imager print(float exposure = 1.2, contrast = 1.1, vignette = 0.35) {
  color c = exposure * Ci;
  c = c * (1 + c / 16) / (1 + 0.6 * c);
  float tone = clamp(0.2126 * comp(c, 0) + 0.7152 * comp(c, 1) + 0.0722 * comp(c, 2), 0, 1);
  c = 0.18 * pow(max(c, color(0)) / 0.18, contrast);
  c *= mix(color(0.94, 0.98, 1.10), color(1.03, 1, 0.95), smoothstep(0.02, 0.35, tone));
  float x = 2 * u - 1, y = 2 * v - 1;
  Ci = c * (1 - vignette * smoothstep(0.5, 2, x * x + y * y));
}
