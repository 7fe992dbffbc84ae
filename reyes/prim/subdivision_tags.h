// Private to the primitives: the tags of a SubdivisionMesh, checked and sorted by their subjects.
#pragma once
#include "reyes/prim/edges.h"
#include "reyes/prim_factories.h"

namespace tomales {

struct MeshTags {
  enum class Boundary { None, EdgeAndCorner, EdgeOnly };
  enum class FaceVaryingBoundary { Linear, EdgeAndCorner, EdgeOnly, AlwaysSharp };

  /// None if the tag is missing: faces at the boundary are not drawn (RISpec section 5.3).
  Boundary boundary = Boundary::None;
  FaceVaryingBoundary faceVarying = FaceVaryingBoundary::Linear;
  bool propagateCorners = false;
  bool smoothTriangles = false;  ///< Catmull-Clark only: other weights for triangles (Stam and Loop 2003's problem).
  bool chaikin = false;          ///< Sharpness of a crease is smoothed along it (DeRose et al. 1998, section 4).
  std::vector<int> creaseEdges;  ///< Vertex pairs.
  std::vector<float> creaseSharpness;
  std::vector<int> corners;
  std::vector<float> cornerSharpness;
  std::vector<int> holes;  ///< Faces.
};

/// Reads tags. A tag that makes no sense is dropped, with a sentence in `problems`. Throws PrimError if the arrays are
/// inconsistent.
MeshTags readTags(const SubdivisionTags& tags, const EdgeFaces& edges, int faceCount, int vertexCount,
                  Problems& problems);

}  // namespace tomales
