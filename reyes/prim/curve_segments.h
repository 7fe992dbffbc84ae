// Curves as they come in RIB (RISpec 3.2, Curves): every segment is a cubic Bezier curve with a width.
// Private to the primitives.
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
/// The piece over [t0, t1].
Cubic<vec4> piece(const Cubic<vec4>& c, float t0, float t1);

struct CurveSegment {
  uint32_t curve, number, of;        ///< Which segment of how many of its curve.
  std::array<uint32_t, 2> corners;   ///< Numbers of its varying values,
  std::array<uint32_t, 4> controls;  ///< and of its vertices; a line has two.
  bool first, last;                  ///< At a loose end.
};

/// The segments of a Curves request, their primvars and their centre lines.
class CurveSegments {
 public:
  /// Throws PrimError like makeCurves().
  CurveSegments(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                const ParamList& params, Problems& problems);

  uint32_t count() const { return static_cast<uint32_t>(segments_.size()); }
  const CurveSegment& operator[](size_t k) const { return segments_[k]; }

  /// Position and width.
  const Cubic<vec4>& line(size_t k) const { return lines_[k]; }
  /// Along a segment, not normalised, and its slope by v; never zero for a segment with a length. At a vertex
  /// of a polyline it is the mean of two directions, so that neighbours meet.
  void direction(size_t k, float v, vec3& along, vec3& slope) const;
  bool cubic() const { return cubic_; }
  /// The segment before or after it in its curve. Pre: it has one there.
  size_t neighbour(size_t k, bool after) const {
    const CurveSegment& s = segments_[k];
    return k - s.number + (s.number + (after ? 1 : s.of - 1)) % s.of;
  }
  /// Of a polyline: a segment's unit direction (0 if it has no length), and at its ends the means with its
  /// neighbours'.
  vec3 chord(size_t k) const;
  const std::array<vec3, 2>& mitres(size_t k) const { return mitres_[k]; }
  /// A primvar's first three components along each segment.
  std::vector<Cubic<vec3>> along(const Primvar& var) const;

  /// Of a primvar: see Prim::interpolate; u does not matter.
  void interpolate(const Primvar& var, size_t k, int n, const float* v, float* out, int stride) const;

  /// Those of the request. They are the owner's to take.
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
