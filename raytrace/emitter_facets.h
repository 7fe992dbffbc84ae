// Flat convex polygons of area lights that are meshes, intersected by directions. Space: any; threads: pure.
#pragma once
#include <array>
#include <optional>

#include "reyes/base/math.h"

namespace tomales {

struct EmitterFacet {
  std::array<vec3, 4> corners;
  vec3 normal;  ///< Unit normal of the shining side.
};

/// Returns nothing if the polygon is not flat or not convex. Two corners may coincide.
std::optional<EmitterFacet> facetOf(const std::array<vec3, 4>& corners, const vec3& normal);

/// Returns the distance to the facet along the unit `direction`; infinite if it is not met.
float distanceToAnySide(const EmitterFacet& facet, const vec3& from, const vec3& direction);
/// Does the same for the shining side alone.
float distanceTo(const EmitterFacet& facet, const vec3& from, const vec3& direction);

}  // namespace tomales
