// Verb: finds the openings of a closed room through which a sky can be seen, by rays.
//   in     the scene's rays, the whole frame (not the crop), and which surfaces are opaque
//   out    rectangles in current space; none where the scene is open, or where they would not help
//   never  decides what light arrives: samples go there more often, and elsewhere too (reyes/shade/portals.h)
// Rule: points that the camera sees, and points that these see, send out rays. Where most points are shut in, the edge
// of the opening is looked for in eight directions around some of the rays that reach the sky. A rectangle around these
// eight places is kept if other points see the sky through it as well (docs/decisions/0185).
#pragma once
#include <vector>

#include "raytrace/trace.h"
#include "reyes/camera.h"

namespace tomales {

/// A rectangle: center, and half of its edges.
struct SkyOpening {
  vec3 center{0}, halfU{0}, halfV{0};
  vec3 normal() const { return normalizeOr(cross(halfU, halfV), vec3(0)); }
  /// Tells whether a ray crosses it.
  bool isCrossed(const vec3& origin, const vec3& direction) const;
};

/// Threads: nobody may change the scene meanwhile.
std::vector<SkyOpening> skyOpenings(const RayScene& rays, const Camera& camera, const ShadingSystem& shading);

}  // namespace tomales
