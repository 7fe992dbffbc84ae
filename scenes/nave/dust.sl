/* The shader walks through dusty air from the eye to the surface in steps. The air glows where the sun reaches it. */
volume dust(float density = 0.014, steps = 120, glow = 0.42; color air = color(0.045, 0.045, 0.05);) {
  float way = length(I);
  vector along = normalize(I);
  point eye = P - I;
  color lit = 0;
  if (raydepth() == 0) {
    float jitter = random();
    uniform float k;
    for (k = 0; k < steps; k += 1) {
      float far = way * (k + jitter) / steps;
      illuminance ("sun", eye + far * along, vector(0, 0, 1), PI) lit += Cl * exp(-density * far);
    }
    lit *= glow * density * way / steps;
  }
  float clear = exp(-density * way);
  Ci = Ci * clear + Oi * (lit + (1 - clear) * air);
}
