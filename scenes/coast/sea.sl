#include "coast.h"

/* Returns the slope of the surface along x and z by waves that are `size` metres long. Waves that are smaller than the
 * width of the filter fade out.
 */
vector waves(point q; float size, width) {
  float fade = 1 - smoothstep(0.25, 0.9, width / size);
  vector lean = vsnoise(point(0.7 * xcomp(q) + 0.3 * zcomp(q), 0, 1.5 * zcomp(q) - 0.4 * xcomp(q)) / size);
  return fade * vector(xcomp(lean), 0, zcomp(lean));
}

/* The sea reflects the evening sky, shows sand where it is shallow, and breaks into white foam along the shore. */
surface sea(color deep = color(0.008, 0.062, 0.085), shallow = color(0.07, 0.27, 0.23), foam = color(0.86, 0.86, 0.84);
            float rough = 0.11) {
  point q = transform("coast", P);
  vector V = -normalize(vtransform("coast", I));
  float distance = length(vtransform("coast", I));
  /* A pixel covers far more of the sea along the view than across it. */
  float across = distance / 1700, along = across / max(ycomp(V), 0.01);
  float width = sqrt(across * along);

  vector lean = 0.9 * waves(q, 40, width) + 0.8 * waves(q, 13, width) + 0.75 * waves(q, 4.2, width) +
                0.6 * waves(q, 1.3, width) + 0.5 * waves(q, 0.45, width);
  vector n = normalize(vector(0, 1, 0) + rough * lean);
  float facing = max(n . V, 0.02);
  vector R = 2 * facing * n - V;
  /* Of waves that are too small to be seen, the eye mostly meets the sides that face it. These sides reflect higher
   * parts of the sky.
   */
  R = vector(xcomp(R), abs(ycomp(R)) + 0.24, zcomp(R));
  float mirrored = 0.02 + 0.98 * pow(1 - min(1, facing + 0.14), 5);

  float bottom = landheight(xcomp(q), zcomp(q));
  float depth = max(0, -bottom);
  float patches = fBm(q / 55, width / 55, 4, 2, 0.5);
  color water = mix(shallow, deep, 1 - exp(-depth * (0.9 + 0.4 * patches)));
  normal up = normalize(ntransform("coast", "current", normal(xcomp(n), ycomp(n), zcomp(n))));
  color light = diffuse(up) + skylight(normal(0, 1, 0));

  /* Breakers follow the depth of the water. Their foam is torn to lace behind the crests. */
  float lace = turbulence(q / 5, width / 5, 5, 2.1, 0.6), torn = fBm(q / 28, width / 28, 4, 2, 0.5);
  float reach = 1 - smoothstep(2.2, 4.6, depth + 1.6 * torn);
  float crest = mod(1.25 * depth + 0.35 * torn + 0.3 * snoise(q / 60), 1);
  float breaker = pow(crest, 2.2) * (1 - smoothstep(0.93, 1, crest));
  float white = reach * smoothstep(0.55, 0.95, breaker + 0.75 * (1 - lace) * smoothstep(0.1, 0.8, crest));
  white = max(white, (1 - smoothstep(0.2, 0.9, depth + 0.8 * torn)) * smoothstep(0.1, 0.7, 1 - lace));
  /* Far out, a few waves have white caps. */
  white = max(white, 0.6 * (1 - lace) * smoothstep(0.62, 0.85, fBm(point(0.5 * xcomp(q), 0, zcomp(q)) / 7, width / 20, 3, 2, 0.5)));

  color mirror = skycolor(R);
  Oi = Os;
  Ci = Os * mix(water * light + mirrored * mirror, foam * light, clamp(white, 0, 1));
}
