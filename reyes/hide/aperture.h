// Private to the hider: the shape of the lens, which maps samples to points on it.
#pragma once
#include <array>

#include "reyes/state.h"

namespace tomales {

class ApertureShape {
 public:
  explicit ApertureShape(const Aperture& aperture);
  /// Maps the unit square to the opening inside the unit disk (x right, y up), by `density`: uniform in area if that is
  /// 0. A disk keeps the shapes of strata (Shirley and Chiu 1997), a polygon their areas.
  vec2 operator()(const vec2& square) const;

 private:
  float rim(float angle) const;
  float radius(float xi) const;

  static constexpr int kSteps = 512;  ///< Entries of a table over one side of the polygon.
  bool disk_;
  float sides_, turn_, roundness_, density_;
  std::array<float, kSteps + 1> areas_{};  ///< Share of a side's area up to an angle.
};

}  // namespace tomales
