// What RayScene is made of, shared by trace.cpp and hit_shade.cpp.
#pragma once
#include "raytrace/embree_scene.h"
#include "raytrace/emitters.h"

namespace tomales {

struct RayScene::Impl {
  Impl(const Scene& scene, const Camera& camera, const ShadingSystem& shading, bool hitList, Log& log);

  Hit resolve(const PolygonHit& hit) const;
  vec3 clearness(const PolygonHit& hit) const { return 1.0f - scene.groups[hit.group].attributes->opacity; }

  const Scene& scene;
  const bool hitList;
  const SharedShapes shapes;
  const std::vector<CoarseGroup> groups;  ///< Without what is in `shapes`, but for deviation and size.
  const EmbreeScene embree;
  const Emitters emitters;
  bool moves = false;                     ///< Some polygon does.
  std::vector<float> displacementBounds;  ///< Of each group, where rays do not see the displacement.
};

}  // namespace tomales
