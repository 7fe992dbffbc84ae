// Hits of rays on solids (SolidBegin ... SolidEnd). All intersections along the whole line are resolved by
// reyes/solid.h, as the hider does for samples (docs/decisions/0032-solids.md). Space: current. Threads: const members
// may be called concurrently.
#pragma once
#include <optional>

#include "raytrace/embree_scene.h"

namespace tomales {

class SolidHits {
 public:
  /// All arguments but `log` must outlive this. `masks`: the rays that see each group.
  SolidHits(const Scene& scene, const std::vector<CoarseGroup>& groups, const std::vector<uint32_t>& masks, Log& log);

  bool none() const { return !embree_; }
  /// Finds the surfaces of solids at -window <= t < ray.tMax that the ray, of `mask`, sees, sorted by t. Its bias and
  /// offset are not used.
  void surfaces(const Ray& ray, float window, uint32_t mask, HitList& out) const;
  size_t bytes() const { return embree_ ? embree_->bytes() : 0; }

 private:
  void resolve(std::span<const PolygonHit> hits, const Ray& ray, uint32_t mask, HitList& out) const;
  const Object& objectOf(const PolygonHit& hit) const {
    return scene_.objects[static_cast<size_t>(groups_[hit.group].latticeOf(hit.quad).object)];
  }

  const Scene& scene_;
  const std::vector<CoarseGroup>& groups_;
  const std::vector<uint32_t>& masks_;
  std::optional<EmbreeScene> embree_;
};

}  // namespace tomales
