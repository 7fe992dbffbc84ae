// Objects that share their shapes (ObjectInstance) are tessellated once, in object space, as finely as the one of them
// that looks largest asks. Not shared: what moves, emits, or is displaced for rays, because each such object has
// polygons of its own; parts of solids and what fades into another level of detail. Threads: immutable once made.
#pragma once
#include "raytrace/tessellate.h"

namespace tomales {

struct CoarseInstance {
  int object;
  uint32_t master;
  mat4 cameraFromObject;
  mat3 normals;  ///< Takes normals to current space, the RISpec side included; not of unit length.
};

struct SharedShapes {
  std::vector<CoarseGroup> masters;  ///< In object space.
  std::vector<CoarseInstance> instances;
  std::vector<bool> shared;  ///< By object: it is one of `instances`.
};

SharedShapes shareShapes(const Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log);

/// Deviation and size of instances belong to their groups too.
void addFigures(const SharedShapes& shapes, const Scene& scene, std::vector<CoarseGroup>& groups);

}  // namespace tomales
