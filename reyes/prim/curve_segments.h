// Private to the primitives: the curves of a request (RISpec 3.2, Curves): every segment is a cubic Bezier curve with a
// width.
#pragma once
#include <array>

#include "reyes/prim/bicubic.h"

namespace tomales {

template <class T>
using Cubic = std::array<T, 4>;

template <class T>
T valueAt(const Cubic<T>& c, float t) {
  const float s = 1 - t;
  return s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3];
}
template <class T>
T slopeAt(const Cubic<T>& c, float t) {
  const float s = 1 - t;
  return 3.0f * (s * s * (c[1] - c[0]) + 2 * s * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
}
template <class T>
T curvatureAt(const Cubic<T>& c, float t) {
  return 6.0f * ((1 - t) * (c[2] - 2.0f * c[1] + c[0]) + t * (c[3] - 2.0f * c[2] + c[1]));
}
/// Returns the piece of the curve over [t0, t1].
Cubic<vec4> piece(const Cubic<vec4>& c, float t0, float t1);

struct CurveSegment {
  uint32_t curve, number, of;        ///< The curve's index, and the segment's index among the curve's `of` segments.
  std::array<uint32_t, 2> corners;   ///< Indices of its varying values.
  std::array<uint32_t, 4> controls;  ///< Indices of its vertices; a line has two.
  bool first, last;                  ///< It is at a loose end.
};

/// The segments of a Curves request, their primvars and their centre lines.
class CurveSegments {
 public:
  /// Throws PrimError like makeCurves().
  CurveSegments(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                const ParamList& params, Problems& problems);

  uint32_t count() const { return static_cast<uint32_t>(segments_.size()); }
  const CurveSegment& operator[](size_t k) const { return segments_[k]; }

  /// Returns position and width.
  const Cubic<vec4>& line(size_t k) const { return lines_[k]; }
  /// Sets the direction along a segment, not normalised, and its derivative by v. The direction is never zero for a
  /// segment with a length. At a vertex of a polyline it is the mean of two directions, so that neighbours meet.
  void direction(size_t k, float v, vec3& along, vec3& slope) const;
  bool cubic() const { return cubic_; }
  /// Returns the segment before or after segment k in its curve. Pre: there is one.
  size_t neighbour(size_t k, bool after) const {
    const CurveSegment& s = segments_[k];
    return k - s.number + (s.number + (after ? 1 : s.of - 1)) % s.of;
  }
  /// Returns the unit direction of a polyline's segment (0 if it has no length). mitres() returns the mean directions
  /// with its neighbours, at its two ends.
  vec3 chord(size_t k) const;
  const std::array<vec3, 2>& mitres(size_t k) const { return mitres_[k]; }
  /// Returns a primvar's first three components along each segment.
  std::vector<Cubic<vec3>> along(const Primvar& var) const;

  /// Interpolates a primvar as Prim::interpolate() does; u does not matter.
  void interpolate(const Primvar& var, size_t k, int n, const float* v, float* out, int stride) const;

  /// Primvars of the request, which the owner moves out.
  std::vector<Primvar> primvars;

  size_t bytes() const;

 private:
  std::vector<Cubic<vec3>> along(const Primvar& var, const float* values) const;
  Cubic<float> componentAlong(const Primvar& var, const float* values, int component, const CurveSegment& s) const;
  void findMitres();

  bool cubic_;
  ToBezier toBezier_;
  std::vector<CurveSegment> segments_;
  std::vector<Cubic<vec4>> lines_;
  std::vector<std::array<vec3, 2>> mitres_;  // of polylines
};

}  // namespace tomales
