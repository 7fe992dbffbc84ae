// Private to polygons: cuts faces of polygons into bilinear patches. A convex quadrilateral is one patch. So is a
// triangle, one edge of which has no length. Every other face is cut into convex pieces first. Each piece becomes
// triangles and quadrilaterals around its centre, which meet the neighbours at the midpoints of the edges
// (docs/decisions/0041).
#pragma once
#include <span>

#include "reyes/prim/interpolation.h"
#include "reyes/prim_factories.h"

namespace tomales {

/// Corners are indices of face-vertices: first those of the RIB, then made points. Made point k is also vertex (number
/// of vertices in the RIB) + k.
struct QuadPatch {
  Corners corners;
  uint32_t face;
  PatchInfo info;
};

/// While all faces are quadrilaterals of one patch, only the PatchInfo of each patch is kept: the corners of patch k
/// are the four face-vertices of face k.
class QuadPatches {
 public:
  size_t size() const { return patches_.empty() ? plain_.size() : patches_.size(); }
  QuadPatch operator[](size_t k) const { return patches_.empty() ? plainPatch(k, plain_[k]) : patches_[k]; }
  void reserve(size_t n) { plain_.reserve(n); }
  void add(const QuadPatch& patch) {
    const QuadPatch plain = plainPatch(plain_.size(), patch.info);
    if (patches_.empty() && plain.face == patch.face && plain.corners == patch.corners)
      return plain_.push_back(patch.info);
    for (size_t k = 0; k < plain_.size(); ++k) patches_.push_back(plainPatch(k, plain_[k]));
    plain_ = {};
    patches_.push_back(patch);
  }
  size_t bytes() const { return patches_.capacity() * sizeof(QuadPatch) + plain_.capacity() * sizeof(PatchInfo); }

 private:
  static QuadPatch plainPatch(size_t k, const PatchInfo& info) {
    const auto first = static_cast<uint32_t>(4 * k);
    return {{first, first + 1, first + 3, first + 2}, static_cast<uint32_t>(k), info};
  }
  std::vector<QuadPatch> patches_;  ///< Empty, or all patches.
  std::vector<PatchInfo> plain_;
};

struct Face {
  vec3 normal;
  bool planar;
};

/// Points made as the means of face-vertices. They lie in flat arrays, because a mesh of pentagons makes six points for
/// each face.
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
  std::vector<Face> faces;  ///< Indexed by RIB face.
  QuadPatches patches;
  MadePoints made;
};

/// Decomposes faces. A face is a run of loops, its outline and its holes; a loop is a run of `vertices`. All counts
/// have been checked. Faces without area at every key, and holes outside of their polygon, are dropped, with a sentence
/// in `problems`. `keys`: the positions at every key of motion, empty if nothing moves. All keys are cut alike if that
/// is possible without overlap at any key; otherwise the first key decides, with a sentence in `problems`.
/// `Decomposition::faces` belong to `positions`.
Decomposition decompose(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts,
                        const std::vector<int>& vertices, const std::vector<vec3>& positions, const PointKeys& keys,
                        Problems& problems);

}  // namespace tomales
