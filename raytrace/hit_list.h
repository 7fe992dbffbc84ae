// Noun and pure functions: the intersections that one ray recorded around its origin, and what "An
// Approximate Global Illumination System", section 4.3, makes of them. Knows nothing of Embree. Threads:
// pure.
#pragma once
#include <cstdint>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// One intersection with a coarse polygon.
struct PolygonHit {
  float t = 0;           ///< From the ray's own origin; negative before it.
  uint32_t group = 0;    ///< Shade group
  uint32_t quad = 0;     ///< In its CoarseGroup, or in the master of its instance; of a chunk the tile
  float u = 0, v = 0;    ///< In the quad, or in the tile
  bool leaving = false;  ///< The ray goes to the side of the RISpec normal.
  int instance = -1;     ///< In SharedShapes::instances, -1: none.
  vec3 normal{0};        ///< Of the polygon, along d/du x d/dv, any length; of an instance in the space of its master.
  int chunk = -1;        ///< In Chunks::all(), -1: none.
};

/// Any length: a fixed capacity would have to drop hits, and which ones matter is known only at the end.
using HitList = std::vector<PolygonHit>;

/// Hits closer together than this share of the offset may be one surface (see sameSurface); hits must be
/// recorded up to recordingWindow() so that both halves of a pair at the offset are in the list.
constexpr float kMergeShare = 0.05f;
inline float mergeDistance(float offset) { return kMergeShare * offset; }
inline float recordingWindow(float offset) { return (1 + kMergeShare) * offset; }

/// By t; the rest of the order makes results independent of the traversal.
void sortAlongRay(HitList& list);

/// A ray that meets an edge of two polygons, or the diagonal of one, reports one surface twice. Surfaces of a
/// closed shape alternate between entering and leaving, so two close hits in the same sense are one surface.
/// The objects may differ: at the crease of two walls a ray leaves both, and neither shadows it.
bool sameSurface(const PolygonHit& a, const PolygonHit& b, float distance);

/// Positions are off by a few units in the last place of their distance from the eye.
inline float roundingAt(const vec3& P) { return 4e-7f * glm::length(P); }

/// What is known about the start of the ray.
struct RayStart {
  float offset = 0;
  float rounding = 0;  ///< Hits no further apart than this lie at the same place for all we know.
  int group = -1;      ///< Shade group that the ray leaves, -1: unknown.
};

/// Does the other side of a wall lie within the offset, besides the origin (-1: none)? Blades and leaves side by side
/// are no walls: it must be of the same group and turned away.
bool isCrowded(const HitList& sorted, int origin, const RayStart& start);

/// The hit that becomes the effective origin: the one closest to t = 0 within the offset. -1: the origin
/// stays. At the line where two walls meet both are there, and the ray may leave one into the other: of
/// equally close hits the one of the ray's own group is its origin, or else one that it leaves.
int effectiveOrigin(const HitList& sorted, const RayStart& start);

/// The first other surface that is not before `origin` (-1: after t = 0), or -1.
int nextHit(const HitList& sorted, int origin, const RayStart& start);

}  // namespace tomales
