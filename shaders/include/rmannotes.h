/* Layers, tiles and random numbers, by the names that S. May's "RManNotes" (Ohio State University, 1995) made known. */
#ifndef RMANNOTES_H
#define RMANNOTES_H

/* Noise from -1 to 1. */
#ifndef snoise
#define snoise(p) (2 * (float noise(p)) - 1)
#endif
#ifndef snoise2
#define snoise2(x, y) (2 * (float noise(x, y)) - 1)
#endif

/* A random number, about even between lo and hi: noise comes near 0 and 1 too rarely. */
#ifndef udn
#define udn(x, lo, hi) mix(lo, hi, smoothstep(0.25, 0.75, float noise(x)))
#endif
#ifndef udn2
#define udn2(x, y, lo, hi) mix(lo, hi, smoothstep(0.25, 0.75, float noise(x, y)))
#endif

/* Is 1 from a to b, with soft edges outside of that. */
#ifndef pulse
#define pulse(a, b, fuzz, x) (smoothstep((a) - (fuzz), a, x) - smoothstep(b, (b) + (fuzz), x))
#endif

/* These lay one layer over another, and give the part that is in both, in either, or in one alone. */
#ifndef blend
#define blend(under, over, opacity) mix(under, over, opacity)
#endif
#ifndef intersection
#define intersection(a, b) ((a) * (b))
#endif
#ifndef union
#define union(a, b) ((a) + (b) - (a) * (b))
#endif
#ifndef difference
#define difference(a, b) ((a) * (1 - (b)))
#endif
#ifndef complement
#define complement(a) (1 - (a))
#endif

/* Divide a unit into `frequency` tiles, and give the position in its tile, from 0 to 1, and the number of the tile. */
#ifndef repeat
#define repeat(position, frequency) mod((position) * (frequency), 1)
#endif
#ifndef whichtile
#define whichtile(position, frequency) floor((position) * (frequency))
#endif
#ifndef even
#define even(x) (mod(x, 2) < 1)
#endif
#ifndef odd
#define odd(x) (mod(x, 2) >= 1)
#endif

/* Polar coordinates around (0.5, 0.5): the radius, 1 at the middle of an edge, and the angle. */
#ifndef topolar2d
#define topolar2d(x, y, r, theta)                              \
  r = 2 * sqrt(((x)-0.5) * ((x)-0.5) + ((y)-0.5) * ((y)-0.5)); \
  theta = atan((y)-0.5, (x)-0.5)
#endif

/* (x, y), rotated around (ox, oy). */
#ifndef rotate2d
#define rotate2d(x, y, radiansturned, ox, oy, rx, ry)                                \
  rx = ((x) - (ox)) * cos(radiansturned) - ((y) - (oy)) * sin(radiansturned) + (ox); \
  ry = ((x) - (ox)) * sin(radiansturned) + ((y) - (oy)) * cos(radiansturned) + (oy)
#endif

#endif
