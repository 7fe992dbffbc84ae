#include "noises.h"

/* Returns the light of disks, as lamps look that are out of focus. Each cell of a grid has one disk or none. */
float disks(float x, y, size, share, seed) {
  float cx = floor(x / size), cy = floor(y / size), sum = 0;
  uniform float i, j;
  for (i = -1; i <= 1; i += 1)
    for (j = -1; j <= 1; j += 1) {
      point cell = point(cx + i, cy + j, seed);
      vector at = vector cellnoise(cell);
      float r = distance(point(x / size, y / size, 0), point(cx + i + xcomp(at), cy + j + ycomp(at), 0));
      float radius = 0.30 + 0.30 * float cellnoise(cell + vector(0, 0, 50));
      float lit = step(1 - share, zcomp(at)) * (0.3 + 0.7 * float cellnoise(cell + vector(0, 0, 90)));
      sum += lit * (1 - smoothstep(0.88, 1, r / radius)) * (0.65 + 0.35 * smoothstep(0.5, 0.95, r / radius));
    }
  return sum;
}

/* Returns the colour of a meadow's far edge and trees in the evening, as a lens with a wide aperture blurs them. The
 * coordinate "up" runs from -1 to 1.
 */
color backdrop(float right, up) {
  float x = 560 * right, y = 315 * up;
  color air = mix(color(0.020, 0.036, 0.010), color(0.16, 0.15, 0.035), smoothstep(-330, -40, y + 40 * snoise(point(x / 210, 1, y / 210))));
  air = mix(air, color(0.022, 0.034, 0.017), smoothstep(-60, 90, y + 60 * snoise(point(x / 160, 5, y / 160))));
  air = mix(air, color(0.15, 0.125, 0.065), smoothstep(170, 380, y + 50 * snoise(point(x / 190, 9, y / 190))));
  float near = exp(-(pow((x + 500) / 420, 2) + pow((y - 330) / 330, 2)));
  air += color(1.1, 0.56, 0.15) * near;
  float lights = disks(x, y, 84, 0.42, 1) + 0.7 * disks(x + 31, y - 17, 58, 0.35, 2);
  float where = smoothstep(-90, 0, y) * (1 - smoothstep(210, 330, y)) * (0.25 + near);
  air += color(0.80, 0.47, 0.13) * 0.3 * lights * where;
  return air + color(0.40, 0.45, 0.10) * 0.07 * disks(x - 9, y + 40, 66, 0.4, 3) * smoothstep(-280, -140, y) * (1 - smoothstep(-100, -20, y));
}

/* This imager puts the backdrop behind the picture and grades it like a photographic print. Bright parts run out
 * softly, shadows become cooler and lights warmer, and the corners become darker.
 */
imager print(float exposure = 1.5, contrast = 1.12, vignette = 0.4) {
  float x = 2 * u - 1, y = 2 * v - 1;
  color c = exposure * (Ci + (1 - alpha) * backdrop(x, -y));
  c = c * (1 + c / 16) / (1 + 0.6 * c);
  float tone = clamp(0.2126 * comp(c, 0) + 0.7152 * comp(c, 1) + 0.0722 * comp(c, 2), 0, 1);
  c = 0.18 * pow(max(c, color(0)) / 0.18, contrast);
  c *= mix(color(0.94, 0.98, 1.10), color(1.03, 1, 0.95), smoothstep(0.02, 0.35, tone));
  Ci = c * (1 - vignette * smoothstep(0.5, 2, x * x + y * y));
  alpha = 1;
  Oi = 1;
}
