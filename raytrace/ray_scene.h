// The members of RayScene, shared by trace.cpp and hit_shade.cpp.
#pragma once
#include <map>
#include <mutex>

#include "raytrace/embree_scene.h"
#include "raytrace/emitters.h"
#include "raytrace/moving_bounds.h"
#include "raytrace/solid_hits.h"
#include "raytrace/volumes.h"

namespace tomales {

inline bool traceable(const Ray& ray) {
  return isFinite(ray.origin) && isFinite(ray.direction) && ray.direction != vec3(0) && ray.tMax > 0;
}

inline RayStart startOf(const Ray& ray) { return {ray.offset, roundingAt(ray.origin), ray.group, ray.direction}; }

struct RayScene::Impl {
  Impl(const Scene& scene, const Camera& camera, const ShadingSystem& shading, const RaySettings& settings, Log& log);

  void resolve(const Ray& ray, const PolygonHit& hit, Hit& out) const;
  Hit resolveChunk(const Ray& ray, const PolygonHit& hit) const;
  /// Tells whether the opacity of all points of the group is that of its attributes.
  bool knowsOpacity(uint32_t group) const { return opacityIsConstant[group]; }
  /// Adds the surfaces of solids to the hits of a traversal of everything else: those up to `window` to the list, and
  /// the nearest after that to `beyond`, if it is nearer. `found`: there was a `beyond`. Returns whether there is one
  /// now.
  bool addSolids(const Ray& ray, float window, uint32_t mask, HitList& list, bool found, PolygonHit& beyond) const;
  vec3 transmittance(const PolygonHit& hit) const { return 1.0f - scene.groups[hit.group].attributes->opacity; }

  TessellationLevel levelOf(const Ray& ray, const vec3& P) const;
  /// Returns the least radius of rays that leave a point which a ray has met at this level. They must see no finer
  /// polygons, because the point lies on polygons of that level. The result is 0 for groups without levels.
  float leastRadius(uint32_t group, TessellationLevel met, const vec3& P) const;

  const Scene& scene;
  const Camera& camera;
  const bool hitList;
  const SharedShapes shapes;
  /// The groups without the polygons of `shapes`, but with the deviation and size of those.
  const std::vector<CoarseGroup> groups;
  const Chunks chunks;
  const std::vector<bool> opacityIsConstant;
  const std::vector<uint32_t> masks;
  const std::vector<bool> opaque;
  const EmbreeScene embree;
  const SolidHits solids;
  const Volumes volumes;
  const Emitters emitters;
  MovingBounds moving;
  mutable std::mutex subsetsMutex;
  mutable std::map<std::pair<std::string, std::string>, std::vector<uint8_t>> subsets;
  mutable std::map<int, std::vector<uint8_t>> besideLamps;
  mutable std::mutex startsMutex;
  mutable std::map<int, Starts> starts;
  std::vector<float> unseenDisplacement;  ///< Indexed by group: RayScene::unseenDisplacement().
};

}  // namespace tomales
