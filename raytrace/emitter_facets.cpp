#include "raytrace/emitter_facets.h"

namespace tomales {
namespace {

/// Returns the distance of P to the left of the edge that leaves corner k, times the edge's length, seen against the
/// normal.
float beside(const EmitterFacet& f, size_t k, const vec3& P) {
  return dot(f.normal, cross(f.corners[(k + 1) % 4] - f.corners[k], P - f.corners[k]));
}

}  // namespace

std::optional<EmitterFacet> facetOf(const std::array<vec3, 4>& corners, const vec3& normal) {
  EmitterFacet out{corners, normal};
  if (dot(normal, cross(corners[2] - corners[0], corners[3] - corners[1])) < 0)
    std::swap(out.corners[1], out.corners[3]);
  const float size = glm::length(corners[2] - corners[0]) + glm::length(corners[3] - corners[1]);
  for (size_t k = 0; k < 4; ++k) {
    if (std::abs(dot(normal, corners[k] - corners[0])) > 1e-5f * size) return std::nullopt;
    for (const vec3& corner : corners)
      if (beside(out, k, corner) < -1e-5f * size * size) return std::nullopt;
  }
  return out;
}

float distanceTo(const EmitterFacet& facet, const vec3& from, const vec3& direction) {
  return dot(facet.normal, direction) < 0 ? distanceToAnySide(facet, from, direction) : kInfinity;
}

float distanceToAnySide(const EmitterFacet& facet, const vec3& from, const vec3& direction) {
  const float t = dot(facet.normal, facet.corners[0] - from) / dot(facet.normal, direction);
  if (!(t > 0)) return kInfinity;
  for (size_t k = 0; k < 4; ++k)
    if (beside(facet, k, from + t * direction) < 0) return kInfinity;
  return t;
}

}  // namespace tomales
