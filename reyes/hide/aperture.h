// Private to the hider: the shape of the lens, which maps samples to points on it.
#pragma once
#include <array>

#include "reyes/state.h"

namespace tomales {

class ApertureShape {
 public:
  explicit ApertureShape(const Aperture& aperture);
  /// Maps the unit square to the opening inside the unit disk (x right, y up), by `density`: uniform in area if that is
  /// 0. A disk keeps the shapes of strata (concentricDisk()), a polygon their areas.
  vec2 operator()(const vec2& square) const;

 private:
  /// Returns the distance of the rim from the centre, at the share `along` of a side from one corner to the next.
  float rim(float along) const;
  /// Returns the share of the way to the rim with density r (1 + density (2 r - 1)): xi is the integral of that density
  /// up to the result.
  float radius(float xi) const;

  static constexpr int kSteps = 512;  ///< Entries of a table over one side of the polygon.
  bool disk_;
  float sides_, turn_, roundness_, density_;
  std::array<float, kSteps + 1> areas_{};  ///< Share of a side's area up to each of kSteps places along it.
};

}  // namespace tomales
