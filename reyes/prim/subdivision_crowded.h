// Private to the primitives: the limit surface of crowded faces, which have a vertex of many faces, or many vertices of
// their own. Bfr refines the neighbourhood of each face separately, which takes N^3 steps around a vertex of N faces;
// here all of them are refined together.
#pragma once
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/ptexIndices.h>

#include "reyes/prim/subdivision_topology.h"

namespace tomales {

class CrowdedFaces {
 public:
  /// Values at all points of the patches of the crowded faces.
  struct Values {
    int width = 0, faceVaryingChannel = -1;
    std::vector<float> points;
  };

  /// Finds the crowded faces among `candidates`. The mesh is refined for them alone; if there are none, nothing is
  /// made.
  CrowdedFaces(const Coarse& mesh, const OpenSubdiv::Far::TopologyLevel& level, const std::vector<int>& candidates);

  bool has(int face) const { return std::binary_search(faces_.begin(), faces_.end(), face); }

  /// Refines values of `width` floats each, given by vertex or for a face-varying channel.
  Values refine(const float* meshValues, int width, int faceVaryingChannel = -1) const;

  /// Evaluates at a point of the face, or of a corner's part of it, in the coordinates of Far's ptex faces. `byU` and
  /// `byV` may be null.
  void evaluate(const Values& values, int face, int corner, float u, float v, float* value, float* byU,
                float* byV) const;

  size_t bytes() const;

 private:
  bool isCrowd(const OpenSubdiv::Far::TopologyLevel& level, int face) const;

  std::vector<int> faces_;  // in order
  Refiner refiner_;
  std::unique_ptr<const OpenSubdiv::Far::PatchTable> table_;
  std::unique_ptr<const OpenSubdiv::Far::PatchMap> map_;
  std::unique_ptr<const OpenSubdiv::Far::PtexIndices> ptex_;
  int regularSize_ = 4;
};

}  // namespace tomales
