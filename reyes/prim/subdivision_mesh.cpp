// Subdivision surfaces (RISpec section 5.3). A patch is a quadrilateral face, or one corner's share of a face of another
// size.
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"
#include "reyes/prim/subdivision_limit.h"
#include "reyes/prim/subdivision_topology.h"

namespace tomales {
namespace {

namespace Far = OpenSubdiv::Far;

class SubdivisionMesh : public Prim {
 public:
  SubdivisionMesh(const Coarse& mesh, std::vector<Primvar> primvars)
      : Prim(std::move(primvars)),
        positions_(mesh.positions),
        refiner_(makeRefiner(mesh)),
        factory_(*refiner_, limitOptions()) {
    size_t channel = 0;
    for (Primvar& var : primvars_) {
      const bool faceVarying = var.storage == Storage::FaceVarying;
      channelOf_.push_back(faceVarying ? static_cast<int>(channel) : -1);
      if (faceVarying) var.values = mesh.channels[channel++].values;
    }
    for (int face = 0; face < refiner_->GetLevel(0).GetNumFaces(); ++face) addPatches(face);
  }

  uint32_t patchCount() const override { return static_cast<uint32_t>(patches_.size()); }
  PatchInfo info(uint32_t patch) const override { return {false, patches_[patch].openEdges}; }

  Bound3 bound(uint32_t patch, const UvRect& rect) const override {
    const Limit limit = limitOf(patches_[patch].face);
    Bound3 hull;
    limit.surface.BoundControlPointsFromMesh(&positions_[0].x, 3, &hull.lo.x, &hull.hi.x);
    return boundLimit(limit, FaceMap(limit.surface, patches_[patch].corner), rect, hull);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    const Limit limit = limitOf(patches_[patch].face);
    evaluateLimit(limit, FaceMap(limit.surface, patches_[patch].corner), n, u, v, out);
  }

  void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                   int stride) const override;

 private:
  struct Patch {
    int face;
    uint16_t corner;  ///< Of the face, if it is not a quadrilateral.
    uint8_t openEdges;
  };

  void addPatches(int face);
  bool isOpen(int face, int edgeOfFace) const;

  Limit limitOf(int face) const {
    Limit limit;
    factory_.InitVertexSurface(face, &limit.surface);
    limit.prepare(&positions_[0].x, 3);
    return limit;
  }

  /// OpenSubdiv does not say what its topology and its table of patches take: about as much as 400 bytes a patch.
  size_t shapeBytes() const override { return bytesOf(positions_) + bytesOf(patches_) + patches_.size() * 400; }
  const std::vector<vec3> positions_;
  const Refiner refiner_;
  const LimitFactory factory_;
  std::vector<int> channelOf_;  // by primvar: its face-varying channel or -1
  std::vector<Patch> patches_;
};

bool SubdivisionMesh::isOpen(int face, int edgeOfFace) const {
  const Far::TopologyLevel& level = refiner_->GetLevel(0);
  for (int other : level.GetEdgeFaces(level.GetFaceEdges(face)[edgeOfFace]))
    if (other != face && factory_.FaceHasLimitSurface(other)) return false;
  return true;
}

void SubdivisionMesh::addPatches(int face) {
  if (!factory_.FaceHasLimitSurface(face)) return;
  const int size = refiner_->GetLevel(0).GetFaceVertices(face).size();
  const auto bit = [&](int edge, PatchEdge bitOfEdge) { return isOpen(face, edge) ? bitOfEdge : 0; };
  if (size == 4) {
    const int open = bit(0, kEdgeV0) | bit(1, kEdgeU1) | bit(2, kEdgeV1) | bit(3, kEdgeU0);
    patches_.push_back({face, 0, static_cast<uint8_t>(open)});
    return;
  }
  for (int k = 0; k < size; ++k) {
    const int open = bit(k, kEdgeV0) | bit((k + size - 1) % size, kEdgeU0);
    patches_.push_back({face, static_cast<uint16_t>(k), static_cast<uint8_t>(open)});
  }
}

void SubdivisionMesh::interpolate(uint32_t patch, int index, int n, const float* u, const float* v,
                                  float* out, int stride) const {
  const Primvar& var = primvars_[static_cast<size_t>(index)];
  const int face = patches_[patch].face;
  if (repeatIfEven(var, static_cast<size_t>(face), n, out, stride)) return;
  Limit limit;
  if (var.storage == Storage::Vertex) factory_.InitVertexSurface(face, &limit.surface);
  if (var.storage == Storage::Varying) factory_.InitVaryingSurface(face, &limit.surface);
  if (var.storage == Storage::FaceVarying)
    factory_.InitFaceVaryingSurface(face, &limit.surface, channelOf_[static_cast<size_t>(index)]);
  limit.prepare(var.values.data(), var.width);
  const FaceMap map(limit.surface, patches_[patch].corner);
  std::vector<float> element(static_cast<size_t>(var.width));
  for (int i = 0; i < n; ++i) {
    const vec2 at = map.at(u[i], v[i]);
    limit.surface.Evaluate(&at.x, limit.points.data(), var.width, element.data());
    for (int c = 0; c < var.width; ++c)
      out[static_cast<ptrdiff_t>(c) * stride + i] = element[static_cast<size_t>(c)];
  }
}

}  // namespace

PrimPtr makeSubdivisionMesh(const std::string& scheme, const std::vector<int>& vertexCounts,
                            const std::vector<int>& vertices, const SubdivisionTags& tags,
                            const ParamList& params, Problems& problems) {
  const auto type = schemeOf(scheme);
  const size_t used = requireFaces(vertexCounts, vertices);
  requireSubdividable(type == OpenSubdiv::Sdc::SCHEME_LOOP ? 3 : 0xffff, vertexCounts, vertices);
  Coarse mesh{type, vertexCounts, vertices, takePositions(params, used, false, problems), {}, {}};
  const size_t vertexCount = mesh.positions.size();
  std::vector<Primvar> primvars =
      takePrimvars(params, {vertexCounts.size(), vertexCount, vertexCount, vertices.size()}, problems);
  mesh.tags = readTags(tags, EdgeFaces(vertexCounts, vertices), static_cast<int>(vertexCounts.size()),
                       static_cast<int>(vertexCount), problems);
  for (const Primvar& var : primvars)
    if (var.storage == Storage::FaceVarying)
      mesh.channels.push_back(mergeFaceVarying(var, vertices, vertexCount));
  auto prim = std::make_shared<SubdivisionMesh>(mesh, std::move(primvars));
  if (prim->patchCount() == 0)
    problems.push_back(
        "no face has a limit surface (all are holes, or lie at a boundary without the tag "
        "\"interpolateboundary\")");
  return prim;
}

}  // namespace tomales
