// What RayScene is made of, shared by trace.cpp and hit_shade.cpp.
#pragma once
#include "raytrace/embree_scene.h"
#include "raytrace/emitters.h"
#include "raytrace/solid_hits.h"

namespace tomales {

struct RayScene::Impl {
  Impl(const Scene& scene, const Camera& camera, const ShadingSystem& shading, bool hitList, Log& log);

  Hit resolve(const PolygonHit& hit) const;
  /// Adds the surfaces of solids to what a traversal of all else has found: those up to `window` to the list, and the nearest
  /// after that, if it is nearer than `beyond`. Returns whether there is a `beyond`.
  bool addSolids(const Ray& ray, float window, uint32_t mask, HitList& list, bool found, PolygonHit& beyond) const;
  vec3 clearness(const PolygonHit& hit) const { return 1.0f - scene.groups[hit.group].attributes->opacity; }

  const Scene& scene;
  const bool hitList;
  const std::vector<CoarseGroup> groups;
  const std::vector<uint32_t> masks;
  const std::vector<bool> opaque;
  const EmbreeScene embree;
  const SolidHits solids;
  const Emitters emitters;
  bool moves = false;                     ///< Some polygon does.
  std::vector<float> displacementBounds;  ///< Of each group, where rays do not see the displacement.
};

}  // namespace tomales
