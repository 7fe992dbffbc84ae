// Private to gi: the points of a batch at which a shader asks for light. Space: current.
#pragma once
#include "reyes/points.h"

namespace tomales {

/// All members outlive the call in which a shader asks.
struct AskedPoints {
  const ShadePoints& points;
  const uint8_t* active;  ///< Indexed by point: the results of points with a 0 are left alone.
  TmConstVec3 N;          ///< The normals of the hemispheres, of any length.

  int count() const { return points.count(); }
  int group() const { return points.group(); }
  /// Returns the unit normal that the shader asks with; the one facing the eye if it has none.
  vec3 normal(int i) const { return normalizeOr(get(N, i), points.facingNormal(i)); }
};

}  // namespace tomales
