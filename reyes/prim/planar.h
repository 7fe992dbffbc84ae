// Private to polygons: a polygon seen along its normal.
#pragma once
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

using Point2 = glm::dvec2;

/// One polygon at each key of its motion (one key if it stands still), without keys at which it has no area.
using Outlines = std::vector<std::vector<Point2>>;

/// Drops the axis along which the polygon is thinnest. Polygons that are counter-clockwise about the normal stay
/// counter-clockwise.
std::vector<Point2> projected(const std::vector<vec3>& points, const glm::dvec3& normal);

/// Returns twice the signed area of triangle abc.
inline double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

inline bool contains(const Point2& a, const Point2& b, const Point2& c, const Point2& p) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

}  // namespace tomales
