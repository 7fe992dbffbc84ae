// Noun and pure functions: the intersections that one ray recorded around its origin, and their evaluation after "An
// Approximate Global Illumination System", section 4.3. It does not know Embree. Threads: pure.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// One intersection with a coarse polygon.
struct PolygonHit {
  float t = 0;         ///< Distance from the ray's own origin; negative before it.
  uint32_t group = 0;  ///< Shade group.
  /// Number in its CoarseGroup, or in the master of its instance; in a chunk the number of the tile.
  uint32_t quad = 0;
  float u = 0, v = 0;    ///< Parameters in the quad, or in the tile.
  bool leaving = false;  ///< The ray goes to the side of the RISpec normal.
  int instance = -1;     ///< Index into SharedShapes::instances; -1: none.
  /// Normal of the polygon, along d/du x d/dv, of any length; for an instance in the space of its master.
  vec3 normal{0};
  int chunk = -1;  ///< Index into Chunks::all(); -1: none.
};

/// A list of any length: a fixed capacity would have to drop hits, and which ones matter is known only at the end.
using HitList = std::vector<PolygonHit>;

/// Hits closer together than this share of the offset may be one surface (see sameSurface); hits must be
/// recorded up to recordingWindow() so that both halves of a pair at the offset are in the list.
constexpr float kMergeShare = 0.05f;
inline float mergeDistance(float offset) { return kMergeShare * offset; }
inline float recordingWindow(float offset) { return (1 + kMergeShare) * offset; }

/// Hit-list distance of a ray at this cosine to the normal. Coarse and fine surface are up to `offset` apart along the
/// normal, so a slanted ray meets the coarse one later; the floor keeps grazing rays from reaching through other
/// objects.
inline float slantedOffset(float offset, float cosine) { return offset / std::max(cosine, 0.25f); }

/// Sorts by t. The rest of the order makes results independent of the traversal.
void sortAlongRay(HitList& list);

/// Tells whether two hits are one surface. A ray that meets an edge of two polygons, or the diagonal of one, reports
/// one surface twice. Surfaces of a closed shape alternate between entering and leaving, so two close hits in the same
/// sense are one surface. The objects may differ: at the crease of two walls a ray leaves both, and neither shadows it.
bool sameSurface(const PolygonHit& a, const PolygonHit& b, float distance);

/// Returns the rounding error of positions: a few units in the last place of their distance from the eye.
inline float roundingAt(const vec3& P) { return 4e-7f * glm::length(P); }

/// The known facts about the start of a ray.
struct RayStart {
  float offset = 0;
  float rounding = 0;  ///< Hits that are no farther apart may lie at the same place.
  int group = -1;      ///< Shade group that the ray leaves; -1: unknown.
  vec3 direction{0};   ///< Of the ray, unit length; zero: every polygon is met at right angles.
};

/// Tells whether a hit is the other face of the sheet that the ray leaves: polygons in the same place that face apart.
/// A scene gives the sides of a surface different shaders by two such polygons with Sides 1. The ray must start on the
/// sheet, at `from`: a wall near the start keeps its other face. Polygons of different instances make no sheet.
bool isOtherFace(const PolygonHit& from, const PolygonHit& hit, const RayStart& start);

/// Tells whether the other side of a wall lies within the offset, besides the origin (-1: none). It has to be of the
/// same group and turned away, because blades and leaves side by side are no walls. A sheet of two faces is none
/// either.
bool isCrowded(const HitList& sorted, int origin, const RayStart& start);

/// Returns the hit that becomes the effective origin: the one closest to t = 0 within the offset, or -1 if the origin
/// stays. On the line where two walls meet there are hits on both, and the ray may go from one to the other. The hit of
/// the ray's own group is then preferred among equally close hits, and after that one that it leaves.
int effectiveOrigin(const HitList& sorted, const RayStart& start);

/// Returns the first hit on another surface that is not before `origin` (-1: after t = 0), or -1. The other face of the
/// sheet at the origin is no other surface.
int nextHit(const HitList& sorted, int origin, const RayStart& start);

}  // namespace tomales
