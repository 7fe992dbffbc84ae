// Coarse quads in a BVH of two levels (instances, chunks), and the two traversals that the hit list needs. Embree is
// known to the files raytrace/embree_* alone. Space: current. Threads: const members may be called concurrently.
#pragma once
#include "raytrace/chunks.h"
#include "raytrace/hit_list.h"
#include "raytrace/resident_cache.h"
#include "raytrace/shared_shapes.h"
#include "raytrace/surroundings.h"
#include "raytrace/tessellate.h"
#include "raytrace/trace.h"

namespace tomales {

class EmbreeScene {
 public:
  /// What belongs to shade group i is visible to rays of masks[i] and opaque if opaque[i]; groupOf: of each instance.
  /// Holds the groups that are parts of solids, or all others and the instances. `groups` and `shapes` must outlive
  /// this. Of groups that fade a ray sees those that have its number in their share: a hash of the ray, within the
  /// share of what it leaves, so that one level of detail does not shadow another in its place. `chunks`, if there are
  /// any, must outlive this too; at most about `chunkBytes` of them are kept.
  EmbreeScene(const std::vector<CoarseGroup>& groups, const SharedShapes& shapes, const std::vector<uint32_t>& groupOf,
              const std::vector<uint32_t>& masks, const std::vector<bool>& opaque, bool solids, Log& log,
              const Chunks* chunks = nullptr, size_t chunkBytes = 0);
  ~EmbreeScene();

  /// Nearest hit with ray.bias < t < ray.tMax; ray.offset plays no part.
  bool nearest(const Ray& ray, uint32_t mask, PolygonHit& hit) const;

  /// Whatever rays of this mask and level may meet within `reach` of P at shutter open. Gives up at chunks and at what
  /// is trimmed or fades.
  void around(const vec3& P, float reach, uint32_t mask, Level level, Surroundings& out) const;

  /// One traversal: fills `list` with all hits at |t| <= window, unsorted, and `beyond` with the nearest
  /// after that. False: nothing beyond before tMax.
  bool nearestBeyond(const Ray& ray, float window, uint32_t mask, HitList& list, PolygonHit& beyond) const;

  /// True if something opaque lies in `window` < t < tMax, where window is negative for rays without a hit
  /// list, which start at their bias. Else `list` has all hits from -window to tMax, unsorted.
  bool blockedBeyond(const Ray& ray, float window, uint32_t mask, HitList& list) const;

  /// Fills `list` with all hits at t >= -window, however far, unsorted.
  void all(const Ray& ray, float window, HitList& list) const;

  /// Unit normal on the RISpec side where a hit of a chunk lies.
  vec3 normal(const PolygonHit& hit) const;

  size_t bytes() const;  ///< That Embree allocated.
  ResidentFigures chunkFigures() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
