// Private to gi: the transformation of a frame's points to world space, in which files are.
#pragma once
#include "reyes/scene.h"

namespace tomales {

struct WorldFromCurrent {
  mat4 points;
  mat3 normals;
  float scale;  ///< Length in world space of one unit of current space.
  explicit WorldFromCurrent(const Scene& scene)
      : points(glm::inverse(scene.cameraFromWorldAtOpen())),
        normals(glm::transpose(mat3(scene.cameraFromWorldAtOpen()))),
        scale(lengthScale(points)) {}
};

}  // namespace tomales
