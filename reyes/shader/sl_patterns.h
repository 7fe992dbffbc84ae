// Patterns that are filtered over a shading sample: the C++ twins of shaders/include/filterwidth.h, noises.h and
// patterns.h, with their names and arguments (A. Apodaca and L. Gritz, "Advanced RenderMan", 1999). A test compares
// them. Shaders of reyes/sl.h include this beside it. Widths are in units of the filtered value, and are at least
// kLeastWidth. filterwidth() asks for derivatives: a surface needs TM_DERIVATIVES for those of s, t, u, v and P, and
// TM_NEIGHBOURS for others. Threads: as reyes/sl.h.
#pragma once
#include "reyes/sl.h"

namespace sl {

constexpr float kLeastWidth = 1e-6f;

/// Returns the change of a value over a micropolygon.
inline Float filterwidth(const Float& x) {
  return max(kLeastWidth, abs(Du(x) * Float(grid()->du)) + abs(Dv(x) * Float(grid()->dv)));
}
/// Returns the side of a square as large as the micropolygon that the points span.
inline Float filterwidthp(const Point& p) { return max(kLeastWidth, sqrt(area(p))); }

/// Returns the share of the interval from x - dx/2 to x + dx/2 that lies between the two edges.
inline Float filteredpulse(const Float& edge0, const Float& edge1, const Float& x, const Float& dx) {
  const Float width = max(dx, kLeastWidth), from = x - width / 2;
  return max(0, (min(from + width, edge1) - max(from, edge0)) / width);
}
/// Returns the integral from 0 to x of a train of pulses, each 1 in the first `edge` of its period.
inline Float pulsetrainintegral(const Float& edge, const Float& period, const Float& x) {
  const Float periods = floor(x / period);
  return periods * edge + min(edge, x - periods * period);
}
/// Returns the share of the interval from x - dx/2 to x + dx/2 that lies within such pulses.
inline Float filteredpulsetrain(const Float& edge, const Float& period, const Float& x, const Float& dx) {
  const Float width = max(dx, kLeastWidth);
  return (pulsetrainintegral(edge, period, x + width / 2) - pulsetrainintegral(edge, period, x - width / 2)) / width;
}

/// Returns noise from -1 to 1.
inline Float snoise(const Triple& p) { return 2 * noise(p) - 1; }
/// Returns snoise() that fades where its waves, one unit long, are narrower than the sample.
inline Float filteredsnoise(const Triple& p, const Float& width) {
  return snoise(p) * (1 - smoothstep(0.2f, 0.75f, width));
}
/// Returns a sum of octaves, each `lacunarity` times as fine and `gain` times as strong as the one before. The function
/// `each` changes the noise of an octave before it is added.
template <class Each>
Float octaves(const Point& p, const Float& width, int most, float lacunarity, float gain, const Each& each) {
  Float sum = 0;
  float strength = 1, frequency = 1;
  for (int octave = 0; octave < most; ++octave, strength *= gain, frequency *= lacunarity)
    sum = sum + strength * each(filteredsnoise(p * frequency, width * frequency));
  return sum;
}
/// Returns a fractal sum of octaves, with both signs.
inline Float fBm(const Point& p, const Float& width, int most = 4, float lacunarity = 2, float gain = 0.5f) {
  return octaves(p, width, most, lacunarity, gain, [](const Float& x) { return x; });
}
/// Returns the same sum of the octaves' magnitudes.
inline Float turbulence(const Point& p, const Float& width, int most = 4, float lacunarity = 2, float gain = 0.5f) {
  return octaves(p, width, most, lacunarity, gain, [](const Float& x) { return abs(x); });
}

}  // namespace sl
