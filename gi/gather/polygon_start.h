// Private to gi: the points where rays of a hemisphere start. A concave surface lies behind its coarse polygons, as
// inside a sphere: rays that leave it at a grazing angle would pass behind all of them and miss what is there. Such
// rays start on the polygon in front. Those that would dive into it leave it at the mirrored angle. Space: current.
// Threads: pure.
#pragma once
#include "raytrace/trace.h"

namespace tomales {

struct PolygonStart {
  vec3 lift{0.0f};    ///< Vector from the point to the start.
  vec3 normal{0.0f};  ///< Unit normal of the polygon, on the side of the hemisphere; zero: the start is no polygon.

  vec3 above(const vec3& direction) const { return direction - 2 * std::min(0.0f, dot(direction, normal)) * normal; }
};

/// `first`: a ray from the point along the hemisphere's normal, prepared with the offset for that direction.
PolygonStart polygonStart(const RayScene& scene, const Ray& first, RayMask mask);

}  // namespace tomales
