/* The shaders of this watch share the studio around it and the ways in which metals reflect it. */
#ifndef MOVEMENT_H
#define MOVEMENT_H

#include "noises.h"

/* Returns the brightness of one softbox, a lamp behind cloth, in direction d. Its azimuth counts in degrees to the
 * right of straight ahead, and its elevation in degrees above the horizon. `wide` and `tall` are its half sizes in
 * degrees, and its edges fade over `fade` degrees.
 */
float softbox(vector d; float azimuth, elevation, wide, tall, fade) {
  float a = mod(degrees(atan(xcomp(d), zcomp(d))) - azimuth + 180, 360) - 180;
  float e = degrees(asin(clamp(ycomp(d), -1, 1))) - elevation;
  return (1 - smoothstep(wide - fade, wide + fade, abs(a))) * (1 - smoothstep(tall - fade, tall + fade, abs(e)));
}

/* Returns the light that the studio sends from a direction in the space of the movement. A warm window, a cool strip
 * and a cloth above light the watch. All of them fade so softly that mirrors show no edges, and a few rays give little
 * noise.
 */
color studiolight(vector d) {
  color sum = mix(color(0.010, 0.011, 0.014), color(0.05, 0.05, 0.055), smoothstep(-0.1, 1, ycomp(d)));
  sum += 2.1 * color(1.0, 0.80, 0.56) * softbox(d, -36, 31, 28, 20, 20);
  sum += 1.6 * color(0.46, 0.67, 1.0) * softbox(d, 40, 27, 24, 22, 17);
  sum += 0.9 * color(1.0, 0.93, 0.84) * softbox(d, 0, 90, 181, 26, 16);
  sum += 0.8 * color(1.0, 0.72, 0.45) * softbox(d, -140, 20, 30, 16, 12);
  return sum;
}

/* Returns what lies in a direction. Points that the eye sees send one ray, and the points that it meets send one more.
 * Further points take the light of the studio without a ray, because rays would not end otherwise.
 */
color seen(vector d; float cone) {
  color c;
  if (raydepth() < 2)
    c = trace(P, d, "samplecone", cone, "samples", 1);
  else
    c = 0.5 * studiolight(vtransform("movement", d));
  return c;
}

/* Returns the light of coloured metal whose scratches all run along one direction. It reflects a fan of directions
 * across them.
 */
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

/* Returns the light of polished metal of a colour. Where two bundles of rays disagree, because they meet scratched metal
 * and each scratch shows another lamp, three times as many rays follow.
 */
color polished(normal Nf; color metal; float cone, samples) {
  vector In = normalize(I), R = normalize(reflect(In, Nf));
  color sum = 0;
  if (raydepth() == 0) {
    /* Two bundles of as many rays would be the same rays. */
    color one = trace(P, R, "samplecone", cone, "samples", 0.6 * samples), other = trace(P, R, "samplecone", cone, "samples", 0.4 * samples);
    sum = mix(other, one, 0.6);
    if (abs(comp(one - other, 0)) > 0.03 + 0.08 * comp(sum, 0))
      sum = mix(trace(P, R, "samplecone", cone, "samples", 3 * samples), sum, 0.25);
  } else
    sum = seen(R, 0);
  return mix(metal, color(1), pow(1 - abs(In . Nf), 5)) * sum;
}

#endif
