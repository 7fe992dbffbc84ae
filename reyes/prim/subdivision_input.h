// Private to the primitives: checks a SubdivisionMesh's arrays before OpenSubdiv sees them.
#pragma once
#include <optional>

#include "reyes/prim.h"

namespace tomales {

/// Throws PrimError for a face that OpenSubdiv would not check: too small, of more than `largest` vertices, or twice at
/// one vertex. Sizes and indices have passed requireFaces().
void requireSubdividable(size_t largest, const std::vector<int>& vertexCounts, const std::vector<int>& vertices);

/// The first vertex around which lie more corners of faces than can be refined in reasonable memory, with their number.
struct Crowd {
  int vertex;
  size_t corners;
};
std::optional<Crowd> crowdBeyondMeasure(const std::vector<int>& vertexCounts, const std::vector<int>& vertices,
                                        size_t vertexCount);

/// A face-varying primvar. Values on which a vertex's faces agree are merged, so that it may be smooth there.
struct FaceVaryingChannel {
  std::vector<int> indices;  ///< Indexed by face-vertex.
  std::vector<float> values;
};

FaceVaryingChannel mergeFaceVarying(const Primvar& var, const std::vector<int>& vertices, size_t vertexCount);

}  // namespace tomales
