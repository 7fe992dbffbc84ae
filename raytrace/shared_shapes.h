// Objects that share their shapes (ObjectInstance) are tessellated once, in object space, as finely as the one of them
// that looks largest requires. Objects that move, emit, or are displaced for rays do not share, because each has
// polygons of its own; nor do parts of solids, and objects that fade into another level of detail. Threads: immutable
// once made.
#pragma once
#include "raytrace/tessellate.h"

namespace tomales {

struct CoarseInstance {
  int object;
  uint32_t group, master;
  mat4 cameraFromObject;
  mat3 normals;  ///< Transforms normals to current space, on the RISpec side; they are not of unit length.
};

struct SharedShapes {
  std::vector<CoarseGroup> masters;  ///< Meshes in object space.
  std::vector<CoarseInstance> instances;
  std::vector<bool> shared;  ///< Indexed by object: true if it is one of `instances`.
};

SharedShapes shareShapes(const Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log);

/// Adds deviation and size of the instances to their groups.
void addFigures(const SharedShapes& shapes, std::vector<CoarseGroup>& groups);

}  // namespace tomales
