// Private to the files that use Embree: the data of its filter functions about a geometry and a traversal. Threads:
// filters run on the threads of the rays; a Traversal belongs to one ray.
#pragma once
#include <embree3/rtcore.h>

#include "raytrace/hit_list.h"
#include "raytrace/level.h"
#include "raytrace/tessellate.h"
#include "raytrace/trace.h"

namespace tomales {

/// Returns Embree's mask for rays with these bits of RayMask at a level, and for the geometries that such rays see.
inline uint32_t maskAt(uint32_t mask, TessellationLevel level) { return mask << 4 * static_cast<int>(level); }
inline uint32_t maskAtAllLevels(uint32_t mask) {
  return maskAt(mask, TessellationLevel::Fine) | maskAt(mask, TessellationLevel::Medium) |
         maskAt(mask, TessellationLevel::Coarse);
}

/// An Embree geometry. Small groups that rays treat alike share one: a geometry of its own for each would cost 65 kB,
/// and a scene may have a group for every object. Their positions and indices are copied for that, about 31 bytes a
/// polygon.
struct Geometry {
  /// Successive quads of one mesh, which are successive in the geometry too.
  struct Run {
    uint32_t mesh, firstQuad, count;
    uint32_t firstPrimitive = 0;
  };

  bool opaque, flips;
  /// Embree's mask of rays that see it; 0 for masters and chunks, whose visibility is that of their groups.
  uint32_t mask;
  DetailShare detail;
  const CoarseGroup* meshes;  ///< All groups, or the one master.
  Run only;
  std::vector<Run> runs{};
  std::vector<uint32_t> runOfQuad{};  ///< Empty: all quads belong to `only`.

  struct Place {
    uint32_t mesh, quad;
  };
  Place place(uint32_t primitive) const {
    const Run& run = runOfQuad.empty() ? only : runs[runOfQuad[primitive]];
    return {run.mesh, run.firstQuad + (primitive - run.firstPrimitive)};
  }
};

/// Instances follow the geometries in the order of Embree's IDs.
struct Instances {
  uint32_t firstId = 0;
  std::vector<uint32_t> group;
  std::vector<bool> opaque;
  std::vector<bool> mirrors;   ///< The transformation changes the orientation of polygons.
  std::vector<uint32_t> mask;  ///< Embree's masks.
  /// Hits of chunks have instance IDs from this on, in the order of chunks; their Geometry holds everything else.
  uint32_t firstChunk = 0;
};

/// The data of one ray for the filters. Embree hands back the address of its first member.
struct Traversal {
  RTCIntersectContext embree;
  float shift = 0;  ///< Embree's t at the ray's own origin.
  float window = 0;
  float tMax = kInfinity;
  HitList* list = nullptr;
  const Instances* instances = nullptr;
  const RayFilter* filter = nullptr;
  float detailNumber = 0;  ///< Number in 0..1 of the ray, which Geometry::detail contains if the ray sees the geometry.

  PolygonHit hit(const Geometry& geometry, float t, uint32_t instanceId, uint32_t primitive, float u, float v,
                 bool leaving, const vec3& normal) const {
    const auto [mesh, quad] = geometry.place(primitive);
    if (instanceId == RTC_INVALID_GEOMETRY_ID) return {t, mesh, quad, u, v, leaving, -1, normal, -1};
    if (instanceId >= instances->firstChunk)
      return {t, mesh, quad, u, v, leaving, -1, normal, static_cast<int>(instanceId - instances->firstChunk)};
    const uint32_t i = instanceId - instances->firstId;
    return {t, instances->group[i], quad, u, v, leaving, static_cast<int>(i), normal, -1};
  }
};
static_assert(std::is_standard_layout_v<Traversal>);

/// Tells whether a ray that meets a polygon with this normal, along d/du x d/dv, goes to the side of the RISpec normal.
inline bool leaves(const vec3& direction, const vec3& normal, bool flips) {
  return (dot(direction, normal) > 0) != flips;
}

// Filters of traversals: Embree calls the context's filter after the geometry's.
void rejectUnseen(const RTCFilterFunctionNArguments* args);  ///< Rejects hits that the ray's RayFilter rejects.
/// Records and rejects hits in the window, accepts those beyond.
void recordNear(const RTCFilterFunctionNArguments* args);
/// Accepts opaque hits beyond the window, which ends the traversal; records and rejects all others.
void recordShadow(const RTCFilterFunctionNArguments* args);
void recordAll(const RTCFilterFunctionNArguments* args);  ///< Records and rejects every hit.
/// The filter of a geometry: rejects hits that trim curves have cut away, and levels of detail that the ray does not
/// see.
void rejectAbsent(const RTCFilterFunctionNArguments* args);

}  // namespace tomales
