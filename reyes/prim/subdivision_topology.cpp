#include "reyes/prim/subdivision_topology.h"

#include <fmt/format.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <mutex>

namespace tomales {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

thread_local std::string lastComplaint;

/// OpenSubdiv prints to stderr unless told otherwise; its sentence becomes part of our message.
void listenToOpenSubdiv() {
  static std::once_flag once;
  std::call_once(once, [] {
    Far::SetErrorCallback([](Far::ErrorType, const char* message) { lastComplaint = message; });
    Far::SetWarningCallback([](const char* message) { lastComplaint = message; });
  });
}

Sdc::Options sdcOptions(const MeshTags& tags) {
  using Options = Sdc::Options;
  static constexpr Options::VtxBoundaryInterpolation kBoundary[] = {
      Options::VTX_BOUNDARY_NONE, Options::VTX_BOUNDARY_EDGE_AND_CORNER, Options::VTX_BOUNDARY_EDGE_ONLY};
  const Options::FVarLinearInterpolation faceVarying[] = {
      Options::FVAR_LINEAR_ALL,
      tags.propagateCorners ? Options::FVAR_LINEAR_CORNERS_PLUS2 : Options::FVAR_LINEAR_CORNERS_PLUS1,
      Options::FVAR_LINEAR_NONE, Options::FVAR_LINEAR_BOUNDARIES};
  Options options;
  options.SetVtxBoundaryInterpolation(kBoundary[static_cast<int>(tags.boundary)]);
  options.SetFVarLinearInterpolation(faceVarying[static_cast<int>(tags.faceVarying)]);
  options.SetCreasingMethod(tags.chaikin ? Options::CREASE_CHAIKIN : Options::CREASE_UNIFORM);
  options.SetTriangleSubdivision(tags.smoothTriangles ? Options::TRI_SUB_SMOOTH : Options::TRI_SUB_CATMARK);
  return options;
}

}  // namespace

Sdc::SchemeType schemeOf(const std::string& scheme) {
  if (scheme == "catmull-clark") return Sdc::SCHEME_CATMARK;
  if (scheme == "loop") return Sdc::SCHEME_LOOP;
  if (scheme == "bilinear") return Sdc::SCHEME_BILINEAR;
  throw PrimError(fmt::format("subdivision scheme \"{}\" is not supported", scheme));
}

Refiner makeRefiner(const Coarse& mesh) {
  listenToOpenSubdiv();
  using Descriptor = Far::TopologyDescriptor;
  std::vector<Descriptor::FVarChannel> channels(mesh.channels.size());
  for (size_t k = 0; k < channels.size(); ++k) {
    const std::vector<int>& indices = mesh.channels[k].indices;
    channels[k].numValues = 1 + *std::max_element(indices.begin(), indices.end());
    channels[k].valueIndices = indices.data();
  }
  Descriptor d;
  d.numVertices = static_cast<int>(mesh.positions.size());
  d.numFaces = static_cast<int>(mesh.vertexCounts.size());
  d.numVertsPerFace = mesh.vertexCounts.data();
  d.vertIndicesPerFace = mesh.vertices.data();
  d.numCreases = static_cast<int>(mesh.tags.creaseSharpness.size());
  d.creaseVertexIndexPairs = mesh.tags.creaseEdges.data();
  d.creaseWeights = mesh.tags.creaseSharpness.data();
  d.numCorners = static_cast<int>(mesh.tags.corners.size());
  d.cornerVertexIndices = mesh.tags.corners.data();
  d.cornerWeights = mesh.tags.cornerSharpness.data();
  d.numHoles = static_cast<int>(mesh.tags.holes.size());
  d.holeIndices = mesh.tags.holes.data();
  d.numFVarChannels = static_cast<int>(channels.size());
  d.fvarChannels = channels.data();
  using RefinerFactory = Far::TopologyRefinerFactory<Descriptor>;
  RefinerFactory::Options options(mesh.scheme, sdcOptions(mesh.tags));
  options.validateFullTopology = true;
  Refiner refiner(RefinerFactory::Create(d, options));
  if (!refiner) throw PrimError("the faces do not make a surface: " + lastComplaint);
  return refiner;
}

}  // namespace tomales
