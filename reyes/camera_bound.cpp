#include "reyes/camera_bound.h"

namespace tomales {

Bound3 cameraBound(const Object& object) {
  Bound3 bound;
  for (const PrimPtr& shape : object.shapes)
    for (uint32_t patch = 0; patch < shape->patchCount(); ++patch)
      for (const mat4& cameraFromObject : object.cameraFromObject.keys)
        bound.extend(transformBound(cameraFromObject, shape->bound(patch, {})));
  return bound.empty() ? bound : bound.grown(object.displacementBound);
}

}  // namespace tomales
