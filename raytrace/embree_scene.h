// Coarse quads in a BVH of two levels (instances, chunks), and the two traversals that the hit list needs. Only the
// files raytrace/embree_* use Embree. Space: current. Threads: const members may be called concurrently.
#pragma once
#include "raytrace/chunks.h"
#include "raytrace/hit_list.h"
#include "raytrace/resident_cache.h"
#include "raytrace/shared_shapes.h"
#include "raytrace/surroundings.h"
#include "raytrace/tessellate.h"
#include "raytrace/trace.h"

namespace tomales {

/// The shade groups of a scene, by number: their polygons, the rays that see them, and whether they let none through.
struct RayGroups {
  const std::vector<CoarseGroup>& meshes;
  const std::vector<uint32_t>& masks;
  const std::vector<bool>& opaque;
};

class EmbreeScene {
 public:
  /// Makes the scene of all groups but parts of solids, of the instances and of the chunks; at most about `chunkBytes`
  /// of these are kept. The meshes, `shapes` and `chunks` must outlive this. Where groups fade between levels of
  /// detail, a ray sees those whose share holds the ray's number. The number is a hash of the ray within the share of
  /// the surface that it leaves, so that one level of detail does not shadow another in its place.
  EmbreeScene(const RayGroups& groups, const SharedShapes& shapes, const Chunks& chunks, size_t chunkBytes, Log& log);
  /// Makes the scene of parts of solids alone.
  EmbreeScene(const RayGroups& groups, Log& log);
  ~EmbreeScene();

  /// Finds the nearest hit with ray.bias < t < ray.tMax; ray.offset is not used.
  bool nearest(const Ray& ray, uint32_t mask, PolygonHit& hit) const;

  /// Collects all polygons that rays of this mask and level may meet within `reach` of P at shutter open. It gives up
  /// where there are chunks, trimmed surfaces or fading ones.
  void around(const vec3& P, float reach, uint32_t mask, TessellationLevel level, Surroundings& out) const;

  /// In one traversal, fills `list` with all hits at |t| <= window, unsorted, and `beyond` with the nearest after that.
  /// Returns false if there is none beyond before tMax.
  bool nearestBeyond(const Ray& ray, float window, uint32_t mask, HitList& list, PolygonHit& beyond) const;

  /// Returns true if something opaque lies in `window` < t < tMax, where window is negative for rays without a hit
  /// list, which start at their bias. Otherwise `list` gets all hits from -window, or from the bias, to tMax, unsorted.
  bool blockedBeyond(const Ray& ray, float window, uint32_t mask, HitList& list) const;

  /// Fills `list` with all hits at t >= -window, however far, unsorted.
  void all(const Ray& ray, float window, HitList& list) const;

  /// Returns the unit normal at a hit of a chunk, on the RISpec side.
  vec3 normal(const PolygonHit& hit) const;

  size_t bytes() const;  ///< Bytes that Embree allocated.
  ResidentFigures chunkFigures() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
