/* This imager grades the picture like a photographic print. Bright parts run out softly, contrast grows a little, and
 * the corners become darker.
 */
imager print(float exposure = 1.25, contrast = 1.18, vignette = 0.25) {
  color c = exposure * Ci;
  c = c * (1 + c / 16) / (1 + 0.45 * c);
  c = 0.18 * pow(max(c, color(0)) / 0.18, contrast);
  float x = 2 * u - 1, y = 2 * v - 1;
  Ci = c * (1 - vignette * smoothstep(0.5, 2, x * x + y * y));
}
