/* Noise with both signs, sums of octaves of it that fade where a sample is too wide for them, and cells of random
 * points (S. Worley, "A Cellular Texture Basis Function", 1996). Names and arguments are those of the header that
 * "Advanced RenderMan" (A. Apodaca and L. Gritz, 1999) made known.
 */
#ifndef NOISES_H
#define NOISES_H

#include "filterwidth.h"

/* Noise from -1 to 1 of a point, a float, or two floats. */
#ifndef snoise
#define snoise(p) (2 * (float noise(p)) - 1)
#endif
#ifndef snoise2
#define snoise2(x, y) (2 * (float noise(x, y)) - 1)
#endif
#ifndef snoisexy
#define snoisexy(x, y) (2 * (float noise(x, y)) - 1)
#endif
#ifndef vsnoise
#define vsnoise(p) (2 * (vector noise(p)) - 1)
#endif

/* The share of noise with waves one unit long that is left in a sample of that width. */
#define noisefade(width) (1 - smoothstep(0.2, 0.75, width))
#ifndef filteredsnoise
#define filteredsnoise(p, width) (snoise(p) * noisefade(width))
#endif
#ifndef filteredvsnoise
#define filteredvsnoise(p, width) (vsnoise(p) * noisefade(width))
#endif

/* A sum of octaves, each `lacunarity` times as fine and `gain` times as strong as the one before. */
float fBm(point p; float filtwidth; uniform float maxoctaves, lacunarity, gain) {
  uniform float octave, strength = 1, frequency = 1;
  float sum = 0;
  for (octave = 0; octave < maxoctaves; octave += 1) {
    sum += strength * filteredsnoise(p * frequency, filtwidth * frequency);
    strength *= gain;
    frequency *= lacunarity;
  }
  return sum;
}

vector vfBm(point p; float filtwidth; uniform float maxoctaves, lacunarity, gain) {
  uniform float octave, strength = 1, frequency = 1;
  vector sum = 0;
  for (octave = 0; octave < maxoctaves; octave += 1) {
    sum += strength * filteredvsnoise(p * frequency, filtwidth * frequency);
    strength *= gain;
    frequency *= lacunarity;
  }
  return sum;
}

#ifndef fBm_default
#define fBm_default(p) fBm(p, filterwidthp(p), 4, 2, 0.5)
#endif
#ifndef vfBm_default
#define vfBm_default(p) vfBm(p, filterwidthp(p), 4, 2, 0.5)
#endif

/* The same sum of the octaves' magnitudes. */
float turbulence(point p; float filtwidth; uniform float maxoctaves, lacunarity, gain) {
  uniform float octave, strength = 1, frequency = 1;
  float sum = 0;
  for (octave = 0; octave < maxoctaves; octave += 1) {
    sum += strength * abs(filteredsnoise(p * frequency, filtwidth * frequency));
    strength *= gain;
    frequency *= lacunarity;
  }
  return sum;
}

#ifndef turbulence_default
#define turbulence_default(p) turbulence(p, filterwidthp(p), 4, 2, 0.5)
#endif

/* Noise at a position that noise has moved. */
#ifndef VLNoise
#define VLNoise(p, scale) (snoise((p) + (scale)*vsnoise(p)))
#endif
#ifndef filteredVLNoise
#define filteredVLNoise(p, width, scale) filteredsnoise((p) + (scale)*filteredvsnoise(p, width), width)
#endif

/* The nearest two of random points, one in each cell of a lattice. With jitter 0 they are the middles of cells. */
void voronoi_f1f2_3d(point p; float jitter; output float f1; output point pos1; output float f2; output point pos2) {
  point middle = point(floor(xcomp(p)) + 0.5, floor(ycomp(p)) + 0.5, floor(zcomp(p)) + 0.5);
  uniform float i, j, k;
  f1 = 1e6;
  f2 = 1e6;
  pos1 = middle;
  pos2 = middle;
  for (i = -1; i <= 1; i += 1)
    for (j = -1; j <= 1; j += 1)
      for (k = -1; k <= 1; k += 1) {
        point cell = middle + vector(i, j, k);
        point candidate = cell + jitter * (vector cellnoise(cell) - 0.5);
        float far = distance(candidate, p);
        if (far < f1) {
          f2 = f1;
          pos2 = pos1;
          f1 = far;
          pos1 = candidate;
        } else if (far < f2) {
          f2 = far;
          pos2 = candidate;
        }
      }
}

void voronoi_f1_3d(point p; float jitter; output float f1; output point pos1) {
  float f2 = 0;
  point pos2 = 0;
  voronoi_f1f2_3d(p, jitter, f1, pos1, f2, pos2);
}

void voronoi_f1f2_2d(float ss, tt; float jitter; output float f1, spos1, tpos1; output float f2, spos2, tpos2) {
  float smiddle = floor(ss) + 0.5, tmiddle = floor(tt) + 0.5;
  uniform float i, j;
  f1 = 1e6;
  f2 = 1e6;
  spos1 = smiddle;
  tpos1 = tmiddle;
  spos2 = smiddle;
  tpos2 = tmiddle;
  for (i = -1; i <= 1; i += 1)
    for (j = -1; j <= 1; j += 1) {
      float scell = smiddle + i, tcell = tmiddle + j;
      float scandidate = scell + jitter * (float cellnoise(scell, tcell) - 0.5);
      float tcandidate = tcell + jitter * (float cellnoise(scell + 31, tcell - 57) - 0.5);
      float sfar = scandidate - ss, tfar = tcandidate - tt;
      float far = sqrt(sfar * sfar + tfar * tfar);
      if (far < f1) {
        f2 = f1;
        spos2 = spos1;
        tpos2 = tpos1;
        f1 = far;
        spos1 = scandidate;
        tpos1 = tcandidate;
      } else if (far < f2) {
        f2 = far;
        spos2 = scandidate;
        tpos2 = tcandidate;
      }
    }
}

void voronoi_f1_2d(float ss, tt; float jitter; output float f1, spos1, tpos1) {
  float f2 = 0, spos2 = 0, tpos2 = 0;
  voronoi_f1f2_2d(ss, tt, jitter, f1, spos1, tpos1, f2, spos2, tpos2);
}

#endif
