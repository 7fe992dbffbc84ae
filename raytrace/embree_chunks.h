// Private to the files that use Embree: chunks (raytrace/chunks.h) as user geometry. A ray that meets a chunk's bound
// goes on in a scene of Embree grids, which is built when it is not in the cache. Chunks of all levels stand in one
// scene: masks select those of the ray's level. Threads: any.
#pragma once
#include <atomic>
#include <deque>

#include "raytrace/chunks.h"
#include "raytrace/embree_filters.h"
#include "raytrace/resident_cache.h"

namespace tomales {

class EmbreeChunks {
 public:
  /// `chunks` must outlive this.
  EmbreeChunks(const Chunks& chunks, size_t budget);
  ~EmbreeChunks();
  EmbreeChunks(const EmbreeChunks&) = delete;

  /// Adds geometries to a scene, one for each mask, with IDs from `id` on. `groups`, `masks` and `opaque`: see
  /// EmbreeScene. Hits have instance IDs from firstInstance on.
  void attach(RTCDevice device, RTCScene to, unsigned id, uint32_t firstInstance,
              const std::vector<CoarseGroup>& groups, const std::vector<uint32_t>& masks,
              const std::vector<bool>& opaque);

  /// Returns Embree's mask of the geometry with this number, counted from the first.
  uint32_t maskOf(size_t geometry) const { return members_[geometry].mask; }
  const Geometry& geometryOf(uint32_t chunk) const { return described_[chunks_.all()[chunk].group]; }
  /// Returns the unit normal at a hit, on the RISpec side.
  vec3 normal(const PolygonHit& hit) const;
  ResidentFigures figures() const { return cache_.figures(); }
  /// Returns true once a ray has passed through a chunk for which there was no memory, because Embree lets no exception
  /// through.
  bool failed() const { return failed_.load(std::memory_order_relaxed); }

 private:
  struct Resident {
    ChunkMesh mesh;
    RTCScene scene = nullptr;
    size_t sceneBytes = 0;

    Resident() = default;
    Resident(const Resident&) = delete;
    ~Resident();
    size_t bytes() const { return sizeof(*this) + mesh.bytes() + sceneBytes; }
  };
  /// The data of one user geometry's callbacks.
  struct Members {
    EmbreeChunks* owner;
    uint32_t mask;
    std::vector<uint32_t> chunks;
  };

  /// Bounds of the vertices of a chunk, tighter than Chunk::bound. They are known once the vertices have been made, and
  /// kept when these are freed.
  struct Extent {
    Bound3 whole;
    std::vector<Bound3> parts;
    std::atomic<bool> known{false};
  };

  /// Returns null if the ray passes by.
  std::shared_ptr<const Resident> met(uint32_t chunk, const RTCRay& r) const;
  std::shared_ptr<const Resident> resident(uint32_t chunk) const;
  std::shared_ptr<const Resident> build(uint32_t chunk) const;
  void learnExtent(uint32_t chunk, const ChunkMesh& mesh) const;
  static void boundsOf(const RTCBoundsFunctionArguments* args);
  static void intersect(const RTCIntersectFunctionNArguments* args);
  static void occluded(const RTCOccludedFunctionNArguments* args);

  const Chunks& chunks_;
  RTCDevice device_ = nullptr;
  uint32_t firstInstance_ = 0;
  std::vector<Geometry> described_;  ///< Indexed by group.
  std::deque<Members> members_;      ///< Embree keeps their addresses.
  mutable ResidentCache<Resident> cache_;
  mutable std::atomic<bool> failed_{false};
  mutable std::vector<Extent> extents_;  ///< Indexed by chunk.
};

}  // namespace tomales
