// Faces of polygons cut into bilinear patches. A convex quadrilateral is one patch; every other face becomes
// quadrilaterals around the centres of its convex pieces, which meet at the midpoints of the edges. Private to polygons.
#pragma once
#include <span>

#include "reyes/prim/interpolation.h"

namespace tomales {

/// Corners are numbered by face-vertex: the RIB's own first, then made points. Made point k is also vertex
/// number (vertices of the RIB) + k.
struct QuadPatch {
  Corners corners;
  uint32_t face;
  PatchInfo info;
};

struct Face {
  vec3 normal;
  bool planar;
};

/// Points made as the means of face-vertices. Flat, because a mesh of triangles makes four points a face.
class MadePoints {
 public:
  size_t count() const { return ends_.size(); }
  void add(std::span<const uint32_t> from) {
    sources_.insert(sources_.end(), from.begin(), from.end());
    ends_.push_back(sources_.size());
  }
  std::span<const uint32_t> sources(size_t k) const {
    const size_t begin = k ? ends_[k - 1] : 0;
    return {&sources_[begin], ends_[k] - begin};
  }

 private:
  std::vector<uint32_t> sources_;
  std::vector<size_t> ends_;
};

struct Decomposition {
  std::vector<Face> faces;  ///< By RIB face.
  std::vector<QuadPatch> patches;
  MadePoints made;
};

/// A face is a run of loops, its outline and its holes; a loop is a run of `vertices`. All counts have been checked. Faces
/// without area and holes outside of their polygon are dropped with a sentence.
Decomposition decompose(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts,
                        const std::vector<int>& vertices, const std::vector<vec3>& positions, Problems& problems);

}  // namespace tomales
