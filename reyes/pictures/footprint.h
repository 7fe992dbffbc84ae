// The area of a picture that one lookup filters over, in a form that OpenImageIO can take.
#pragma once
#include <algorithm>
#include <cmath>

namespace tomales {

/// The edges of a parallelogram in s and t.
struct Footprint {
  double su, tu, sv, tv;
};

/// OpenImageIO aborts where a filter with blur is flat, as in texture("a", s, s, "blur", 0.1), or very long. Such a
/// footprint keeps its longer edge and gets a short one across it. The result is the same, because OpenImageIO has no
/// filter flatter than 1 to 32, and long filters return the mean of the picture. Pre: the edges are finite.
inline Footprint soundFootprint(const Footprint& f) {
  constexpr double kLongest = 1e3, kFlattest = 1e-2, kShortest = 1e-7;
  const double u = std::hypot(f.su, f.tu), v = std::hypot(f.sv, f.tv), longer = std::max(u, v);
  const double scale = longer > kLongest ? kLongest / longer : 1, length = longer * scale;
  const Footprint out{f.su * scale, f.tu * scale, f.sv * scale, f.tv * scale};
  if (std::abs(out.su * out.tv - out.tu * out.sv) >= kFlattest * length * length) return out;
  const double s = u > v ? out.su : out.sv, t = u > v ? out.tu : out.tv;
  const double across = std::max(kFlattest * length, kShortest) / length;
  return {s, t, -t * across, s * across};
}

}  // namespace tomales
