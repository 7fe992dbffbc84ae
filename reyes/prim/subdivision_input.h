// Private to the primitives: checks a SubdivisionMesh's arrays before OpenSubdiv sees them.
#pragma once
#include <optional>

#include "reyes/prim_factories.h"

namespace tomales {

/// Throws PrimError for a face that OpenSubdiv does not check: one that is too small, has more than `largest` vertices,
/// or meets a vertex twice. Pre: sizes and indices have passed requireFaces().
void requireSubdividable(size_t largest, const std::vector<int>& vertexCounts, const std::vector<int>& vertices);

/// The first vertex that has more corners of faces around it than can be refined in reasonable memory, and their
/// number.
struct Crowd {
  int vertex;
  size_t corners;
};
std::optional<Crowd> crowdBeyondMeasure(const std::vector<int>& vertexCounts, const std::vector<int>& vertices,
                                        size_t vertexCount);

/// A face-varying primvar. Values on which the faces of a vertex agree are merged, so that the primvar may be smooth
/// there.
struct FaceVaryingChannel {
  std::vector<int> indices;  ///< Indexed by face-vertex.
  std::vector<float> values;
};

FaceVaryingChannel mergeFaceVarying(const Primvar& var, const std::vector<int>& vertices, size_t vertexCount);

}  // namespace tomales
