// The topology of a SubdivisionMesh as OpenSubdiv wants it. Private to the primitives.
#pragma once
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

#include "reyes/prim/subdivision_input.h"
#include "reyes/prim/subdivision_tags.h"

namespace tomales {

using Refiner = std::unique_ptr<OpenSubdiv::Far::TopologyRefiner>;

/// Throws PrimError for a scheme that nobody knows.
OpenSubdiv::Sdc::SchemeType schemeOf(const std::string& scheme);

/// What a mesh is made of, checked.
struct Coarse {
  OpenSubdiv::Sdc::SchemeType scheme;
  std::vector<int> vertexCounts, vertices;
  std::vector<vec3> positions;
  MeshTags tags;
  std::vector<FaceVaryingChannel> channels;
};

/// Not refined. Throws PrimError with OpenSubdiv's complaint if the faces do not make a surface.
Refiner makeRefiner(const Coarse& mesh);

}  // namespace tomales
