/* Dusty air shows where light passes through it. The shader marches from the eye to the surface in steps and gathers
   the light at each step. */
volume dust(float density = 0.05, steps = 24; color dustcolor = 1; float uneven = 0.5, frequency = 0.7) {
  float stride = length(I) / steps, clear = 1, k;
  color glow = 0;
  for (k = 0; k < steps; k += 1) {
    /* Each step has a random offset of its own. One offset for the whole ray would leave bands. */
    point Q = P - I + ((k + random()) / steps) * I;
    float d = density * (1 - uneven + 2 * uneven * float noise(frequency * transform("shader", Q)));
    float passes = exp(-d * stride);
    color lit = 0;
    illuminance (Q) lit += Cl;
    glow += clear * (1 - passes) * dustcolor * lit / (4 * PI);
    clear *= passes;
  }
  Ci = Ci * clear + glow;
  Oi = 1 - (1 - Oi) * clear;
}
