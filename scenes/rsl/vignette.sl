/* The corners of the picture become darker, as old lenses make them. */
imager vignette(float strength = 0.6, inner = 0.55, outer = 1.3; color background = 0) {
  uniform float size[3];
  float aspect = 1;
  if (option("Format", size) == 1) aspect = size[0] / size[1];
  /* y runs from -1 to 1 over the height of the picture. */
  float x = (2 * u - 1) * aspect, y = 2 * v - 1;
  float far = sqrt(x * x + y * y) / sqrt(1 + aspect * aspect);
  Ci = (Ci + (1 - alpha) * background) * (1 - strength * smoothstep(inner, outer, far));
  Oi = 1;
  alpha = 1;
}
