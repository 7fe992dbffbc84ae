#include "noises.h"
#include "patterns.h"

/* This is a brick wall in running bond. Edges are filtered over the area of a sample. A distant wall therefore shows
   its mean colour and does not flicker. */
surface bricks(float Ka = 1, Kd = 0.85;
               float brickwidth = 0.25, brickheight = 0.08, mortar = 0.012;
               float depth = 0.02, rough = 0.35;
               color brickcolor = color(0.42, 0.14, 0.085), mortarcolor = color(0.46, 0.43, 0.38);
               output varying float brick = 0, which = 0) {
  float ss = s / brickwidth, tt = t / brickheight;
  uniform float gaps = mortar / brickwidth, gapt = mortar / brickheight;
  float column, row, across, along;
  brick = tilepattern(ss, tt, filterwidth(ss), filterwidth(tt), gaps, gapt, column, row, across, along);
  which = cellnoise(column + 0.5, row + 0.5);

  point q = transform("shader", P);
  float spots = fBm(14 * q, 14 * filterwidthp(q), 4, 2, 0.6);
  color clay = varyEach(brickcolor, column + 57 * row, 0.03, 0.15, 0.12) * (1 + rough * spots);
  color base = mix(mortarcolor * (1 + 0.3 * spots), clay, brick);

  /* The joints lie deeper and the clay is rough, but only the normal shows it. The edges of the height have a fixed
     softness. An edge that depended on a filter width would need the derivative of a derivative. */
  float edge(float x, gap) { return smoothpulse(0, gap, 1 - gap, 1, x); }
  float height = depth * edge(across, gaps) * edge(along, gapt) + 0.01 * snoise(20 * q) + 0.004 * snoise(55 * q);
  normal Nf = faceforward(calculatenormal(P + height * normalize(N)), I, Ng);
  Oi = Os;
  Ci = Os * base * (Ka * ambient() + Kd * diffuse(Nf));
}
