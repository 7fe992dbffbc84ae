// A mesh as primitives of RIB, in its own space. Threads: plain function.
#pragma once
#include <assimp/mesh.h>

#include "reyes/bindings/assimp/look.h"
#include "reyes/bindings/assimp/rib_calls.h"

namespace tomales::model {

struct GeometrySettings {
  bool subdivide = false;
  float smooth_degrees = 45;
  bool keepsNormals = true;      ///< False: the normals of the file add nothing to its faces.
  std::vector<vec3> faceColors;  ///< Used if there is one for each face, and the vertices have no colours.
};

struct Geometry {
  Requests requests;      ///< Polygons or a subdivision surface, linear curves, points; empty if nothing can be drawn.
  size_t values = 0;      ///< Numbers in them.
  int unusableFaces = 0;  ///< Faces that are left out, because their coordinates are not finite.
};

/// Colours of vertices multiply the colour of the look, and their alphas its opacity.
Geometry geometryOf(const aiMesh& mesh, const Look& look, const GeometrySettings& settings);

/// Returns the bound of all finite vertices.
Bound3 boundOf(const aiMesh& mesh);

}  // namespace tomales::model
