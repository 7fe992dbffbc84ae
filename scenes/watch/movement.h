/* What the shaders of this watch share: the studio around it, and how metals mirror it. */
#ifndef MOVEMENT_H
#define MOVEMENT_H

#include "noises.h"

/* One lamp of the studio, a box of cloth: degrees to the right of straight ahead and above the horizon, how far it reaches
 * to each side, and over how many degrees it fades.
 */
float softbox(vector d; float azimuth, elevation, wide, tall, fade) {
  float a = mod(degrees(atan(xcomp(d), zcomp(d))) - azimuth + 180, 360) - 180;
  float e = degrees(asin(clamp(ycomp(d), -1, 1))) - elevation;
  return (1 - smoothstep(wide - fade, wide + fade, abs(a))) * (1 - smoothstep(tall - fade, tall + fade, abs(e)));
}

/* What the studio sends from a direction, in the space of the movement: a warm window, a cool strip, a cloth above. All of
 * it fades so softly that a mirror shows no edge and few rays show no noise.
 */
color studiolight(vector d) {
  color sum = mix(color(0.010, 0.011, 0.014), color(0.05, 0.05, 0.055), smoothstep(-0.1, 1, ycomp(d)));
  sum += 2.1 * color(1.0, 0.80, 0.56) * softbox(d, -36, 31, 28, 20, 20);
  sum += 1.6 * color(0.46, 0.67, 1.0) * softbox(d, 40, 27, 24, 22, 17);
  sum += 0.9 * color(1.0, 0.93, 0.84) * softbox(d, 0, 90, 181, 26, 16);
  sum += 0.8 * color(1.0, 0.72, 0.45) * softbox(d, -140, 20, 30, 16, 12);
  return sum;
}

/* What lies in a direction. Points that the eye sees send one ray, and what these meet sends one more; what lies still
 * further is taken for the studio, because rays would not end otherwise.
 */
color seen(vector d; float cone) {
  color c;
  if (raydepth() < 2)
    c = trace(P, d, "samplecone", cone, "samples", 1);
  else
    c = 0.5 * studiolight(vtransform("movement", d));
  return c;
}

/* Metal of a colour whose scratches all run along one direction: it mirrors a fan of directions across them. */
color brushed(normal Nf; vector across; color metal; float spread, samples) {
  vector In = normalize(I);
  float count = raydepth() == 0 ? samples : 1, k;
  color sum = 0;
  for (k = 0; k < count; k += 1) {
    float t = 2 * (k + float random()) / count - 1;
    sum += seen(normalize(reflect(In, normalize(Nf + spread * t * across))), 0.02);
  }
  return mix(metal, color(1), pow(1 - abs(In . Nf), 5)) * sum / count;
}

/* Polished metal of a colour. */
color polished(normal Nf; color metal; float cone, samples) {
  vector In = normalize(I), R = normalize(reflect(In, Nf));
  color sum = 0;
  if (raydepth() == 0)
    sum = trace(P, R, "samplecone", cone, "samples", samples);
  else
    sum = seen(R, 0);
  return mix(metal, color(1), pow(1 - abs(In . Nf), 5)) * sum;
}

#endif
