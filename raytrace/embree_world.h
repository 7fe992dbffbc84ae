// Private to the files that use Embree: Embree's device and scene, and what stands behind its geometries. Space:
// current. Threads: it is built by one; const members may be used by many.
#pragma once
#include <atomic>
#include <deque>
#include <optional>

#include "raytrace/embree_chunks.h"
#include "raytrace/embree_scene.h"

namespace tomales {

struct EmbreeWorld {
  /// Both must outlive this. Throws std::bad_alloc where memory does not suffice, and std::runtime_error if Embree does
  /// not start.
  EmbreeWorld(const std::vector<CoarseGroup>& groups, const SharedShapes& shapes);
  ~EmbreeWorld();
  EmbreeWorld(const EmbreeWorld&) = delete;

  /// Attaches the groups that are parts of solids, or all others.
  void attachGroups(const RayGroups& all, bool solids);
  void attachInstances(const RayGroups& all);
  /// Ends the building. Throws std::bad_alloc where memory does not suffice.
  void commit(Log& log);

  const std::vector<CoarseGroup>& groups;
  const SharedShapes& shapes;
  bool fades = false;  ///< Some group fades between levels of detail.
  std::atomic<int64_t> bytes{0};
  std::deque<Geometry> geometries;  ///< Indexed by geomID of Embree; Embree keeps their addresses.
  std::deque<Geometry> masters;
  Instances instances;
  std::optional<EmbreeChunks> chunks;
  const RTCDevice device;
  RTCScene scene = nullptr;

 private:
  static bool countBytes(void* self, ssize_t bytes, bool);
  RTCScene newScene() const;
  /// Adds one geometry with the quads of the given groups.
  void attach(std::vector<Geometry::Run> runs, uint32_t mask, bool opaque);
  RTCScene sceneOf(const CoarseGroup& mesh);
};

}  // namespace tomales
