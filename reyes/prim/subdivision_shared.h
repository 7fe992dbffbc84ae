// What meshes of the same faces share, wherever their vertices are: OpenSubdiv's topology and its patches around
// irregular vertices, which are tens of kilobytes for a box of six faces. Private to the primitives.
#pragma once
#include "reyes/prim/subdivision_limit.h"
#include "reyes/prim/subdivision_topology.h"

namespace tomales {

struct SharedFaces {
  explicit SharedFaces(const Coarse& mesh) : refiner(makeRefiner(mesh)), factory(*refiner, limitOptions()) {}
  const Refiner refiner;
  const LimitFactory factory;
};

/// Of this mesh; that of an earlier mesh where all but positions and values is the same. Throws PrimError as
/// makeRefiner. Threads: any.
std::shared_ptr<const SharedFaces> sharedFaces(const Coarse& mesh);

}  // namespace tomales
