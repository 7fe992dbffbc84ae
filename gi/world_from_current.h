// The transformation of a frame's points to world space, in which files are.
#pragma once
#include "reyes/scene.h"

namespace tomales {

struct WorldFromCurrent {
  mat4 points;
  mat3 normals;
  mat3 currentNormals;  ///< The way back: normals of current space from those of world space.
  float scale;          ///< Length in world space of one unit of current space.
  explicit WorldFromCurrent(const Scene& scene) : WorldFromCurrent(scene.cameraFromWorldAtOpen()) {}
  explicit WorldFromCurrent(const mat4& currentFromWorld)
      : points(glm::inverse(currentFromWorld)),
        normals(glm::transpose(mat3(currentFromWorld))),
        currentNormals(glm::transpose(mat3(points))),
        scale(lengthScale(points)) {}
};

}  // namespace tomales
