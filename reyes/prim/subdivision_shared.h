// Private to the primitives: data that meshes of the same faces share, wherever their vertices are: OpenSubdiv's
// topology and its patches around irregular vertices, which take tens of kilobytes for a box of six faces.
#pragma once
#include "reyes/prim/subdivision_limit.h"
#include "reyes/prim/subdivision_topology.h"

namespace tomales {

struct SharedFaces {
  explicit SharedFaces(const Coarse& mesh) : refiner(makeRefiner(mesh)), factory(*refiner, limitOptions()) {}
  const Refiner refiner;
  const LimitFactory factory;
};

/// Returns the data of this mesh, shared with an earlier mesh where all but positions and values is the same. Throws
/// PrimError like makeRefiner(). Threads: any.
std::shared_ptr<const SharedFaces> sharedFaces(const Coarse& mesh);

}  // namespace tomales
