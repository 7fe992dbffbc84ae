// Private to the primitives: the topology of a SubdivisionMesh in the form that OpenSubdiv takes.
#pragma once
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

#include "reyes/prim/subdivision_input.h"
#include "reyes/prim/subdivision_tags.h"

namespace tomales {

using Refiner = std::unique_ptr<OpenSubdiv::Far::TopologyRefiner>;

/// Throws PrimError for an unknown scheme.
OpenSubdiv::Sdc::SchemeType schemeOf(const std::string& scheme);

/// The checked arrays of a mesh.
struct Coarse {
  OpenSubdiv::Sdc::SchemeType scheme;
  std::vector<int> vertexCounts, vertices;
  std::vector<vec3> positions;
  MeshTags tags;
  std::vector<FaceVaryingChannel> channels;
};

/// Makes a refiner that is not refined yet. Throws PrimError with OpenSubdiv's message if the faces do not make a
/// surface.
Refiner makeRefiner(const Coarse& mesh);

}  // namespace tomales
