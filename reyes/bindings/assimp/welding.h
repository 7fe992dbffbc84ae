// Vertices of one mesh that lie at the same place become one point, as subdivision and neighbouring dicing rates need:
// most formats repeat a vertex wherever normals or texture coordinates differ.
#pragma once
#include <assimp/mesh.h>

#include <vector>

#include "reyes/base/math.h"

namespace tomales::model {

struct Welded {
  std::vector<vec3> points;   ///< Points that the faces use.
  std::vector<int> pointOf;   ///< Indexed by vertex of the mesh; -1: no face uses it.
  std::vector<int> vertexOf;  ///< Indexed by point: the first vertex that lies there.
  bool oneToOne = true;       ///< No two vertices in use share a point.
};

/// `corners`: vertices of the mesh, all of finite coordinates.
Welded weld(const aiMesh& mesh, const std::vector<int>& corners);

}  // namespace tomales::model
