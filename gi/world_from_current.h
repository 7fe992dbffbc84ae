// Private to gi: points of a frame on their way to files, which are in world space.
#pragma once
#include "reyes/scene.h"

namespace tomales {

struct WorldFromCurrent {
  mat4 points;
  mat3 normals;
  float scale;  ///< Length of one of current space.
  explicit WorldFromCurrent(const Scene& scene)
      : points(glm::inverse(scene.cameraFromWorldAtOpen())),
        normals(glm::transpose(mat3(scene.cameraFromWorldAtOpen()))),
        scale(std::cbrt(std::abs(glm::determinant(mat3(points))))) {}
};

}  // namespace tomales
