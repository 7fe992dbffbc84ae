// Subdivision surfaces (RISpec section 5.3). A patch is a quadrilateral face, or one corner's part of a face of another
// size.
#include <fmt/format.h>

#include <atomic>
#include <optional>

#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"
#include "reyes/prim/subdivision_crowded.h"
#include "reyes/prim/subdivision_shared.h"

namespace tomales {
namespace {

namespace Far = OpenSubdiv::Far;

/// A face's limit surface with data for evaluation and bounds.
struct PositionLimit : Limit {
  std::optional<BezierPatch> bicubic;
  Bound3 hull;  ///< Bound of the control points.
};

/// Returns a number that no other mesh has, not even a deleted one.
uint64_t nextId() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

class SubdivisionMesh : public Prim {
 public:
  SubdivisionMesh(const Coarse& mesh, std::vector<Primvar> primvars)
      : Prim(std::move(primvars)),
        positions_(mesh.positions),
        faces_(sharedFaces(mesh)),
        refiner_(*faces_->refiner),
        factory_(faces_->factory),
        crowded_(mesh, refiner_.GetLevel(0), facesWithSurface()),
        crowdedPositions_(crowded_.refine(&positions_[0].x, 3)) {
    for (const vec3& p : positions_) hull_.extend(p);
    size_t channel = 0;
    for (Primvar& var : primvars_) {
      const bool faceVarying = var.storage == Storage::FaceVarying;
      channelOf_.push_back(faceVarying ? static_cast<int>(channel) : -1);
      if (faceVarying) var.values = mesh.channels[channel++].values;
      const bool smooth = faceVarying || var.storage == Storage::Vertex;
      crowdedValues_.push_back(smooth ? crowded_.refine(var.values.data(), var.width, channelOf_.back())
                                      : CrowdedFaces::Values{});
    }
    for (int face = 0; face < refiner_.GetLevel(0).GetNumFaces(); ++face) addPatches(face);
  }

  uint32_t patchCount() const override { return static_cast<uint32_t>(patches_.size()); }
  PatchInfo info(uint32_t patch) const override { return {.openEdges = patches_[patch].openEdges}; }

  Bound3 bound(uint32_t patch, const UvRect& rect) const override {
    const Patch& p = patches_[patch];
    if (crowded_.has(p.face)) return boundFace(crowdedAt(p), mapOfCrowded(p), rect, hull_);
    const PositionLimit& limit = positionsOf(p.face);
    return limit.bicubic ? boundBicubic(*limit.bicubic, rect) : boundFace(limitAt(limit), mapOf(p), rect, limit.hull);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    const Patch& p = patches_[patch];
    if (crowded_.has(p.face)) return evaluateFace(crowdedAt(p), mapOfCrowded(p), n, u, v, out);
    const PositionLimit& limit = positionsOf(p.face);
    if (limit.bicubic) return evaluateBicubic(*limit.bicubic, n, u, v, out);
    evaluateFace(limitAt(limit), mapOf(p), n, u, v, out);
  }

  void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                   int stride) const override;

 private:
  struct Patch {
    int face;
    uint16_t corner;  ///< Corner of the face, if it is not a quadrilateral.
    uint8_t openEdges;
  };

  void addPatches(int face);
  bool isOpen(int face, int edgeOfFace) const;

  std::vector<int> facesWithSurface() const {
    std::vector<int> faces;
    for (int face = 0; face < refiner_.GetLevel(0).GetNumFaces(); ++face)
      if (factory_.FaceHasLimitSurface(face)) faces.push_back(face);
    return faces;
  }

  FaceMap mapOf(const Patch& p) const { return {factory_.GetFaceParameterization(p.face), p.corner}; }
  /// Far uses a corner's own coordinates for its part of a face, and triangles whole.
  FaceMap mapOfCrowded(const Patch& p) const {
    return factory_.GetSchemeType() == OpenSubdiv::Sdc::SCHEME_LOOP ? mapOf(p) : FaceMap();
  }

  FaceAt crowdedAt(const Patch& p) const {
    return [this, p](const vec2& at, vec3* ds, vec3* dt) {
      vec3 position;
      crowded_.evaluate(crowdedPositions_, p.face, p.corner, at.x, at.y, &position.x, ds ? &ds->x : nullptr,
                        dt ? &dt->x : nullptr);
      return position;
    };
  }
  static FaceAt limitAt(const PositionLimit& limit) {
    return [&limit](const vec2& at, vec3* ds, vec3* dt) {
      vec3 position;
      if (ds && dt)
        limit.surface.Evaluate(&at.x, limit.points.data(), 3, &position.x, &ds->x, &dt->x);
      else
        limit.surface.Evaluate(&at.x, limit.points.data(), 3, &position.x);
      return position;
    };
  }

  const PositionLimit& positionsOf(int face) const;

  /// OpenSubdiv does not tell the size of its topology and its patch table: they take about 400 bytes for each patch.
  size_t shapeBytes() const override {
    size_t bytes = bytesOf(positions_) + bytesOf(patches_) + patches_.size() * 400 + crowded_.bytes() +
                   bytesOf(crowdedPositions_.points);
    for (const auto& values : crowdedValues_) bytes += bytesOf(values.points);
    return bytes;
  }
  const uint64_t id_ = nextId();
  const std::vector<vec3> positions_;
  const std::shared_ptr<const SharedFaces> faces_;
  const Far::TopologyRefiner& refiner_;
  const LimitFactory& factory_;
  const CrowdedFaces crowded_;
  const CrowdedFaces::Values crowdedPositions_;
  std::vector<CrowdedFaces::Values> crowdedValues_;  // Indexed by primvar.
  Bound3 hull_;                                      // Bound of all positions.
  std::vector<int> channelOf_;                       // Indexed by primvar: its face-varying channel or -1.
  std::vector<Patch> patches_;
};

/// Splitting evaluates bound and points of one face repeatedly, and dicing does so at every key: each thread keeps the
/// faces that it prepared last. The result is valid until the thread has asked for kKept other faces.
const PositionLimit& SubdivisionMesh::positionsOf(int face) const {
  struct Kept {
    uint64_t mesh = 0;
    int face = -1;
    std::unique_ptr<PositionLimit> limit;  // Bfr's surfaces do not survive a second initialisation
  };
  constexpr size_t kKept = 4;
  static thread_local std::array<Kept, kKept> kept;
  static thread_local size_t oldest = 0;
  for (const Kept& k : kept)
    if (k.mesh == id_ && k.face == face) return *k.limit;
  auto limit = std::make_unique<PositionLimit>();
  factory_.InitVertexSurface(face, &limit->surface);
  limit->prepare(&positions_[0].x, 3);
  limit->surface.BoundControlPoints(limit->points.data(), 3, &limit->hull.lo.x, &limit->hull.hi.x);
  limit->bicubic = asBicubic(*limit);
  Kept& place = kept[oldest++ % kKept];
  place = {id_, face, std::move(limit)};
  return *place.limit;
}

bool SubdivisionMesh::isOpen(int face, int edgeOfFace) const {
  const Far::TopologyLevel& level = refiner_.GetLevel(0);
  for (int other : level.GetEdgeFaces(level.GetFaceEdges(face)[edgeOfFace]))
    if (other != face && factory_.FaceHasLimitSurface(other)) return false;
  return true;
}

void SubdivisionMesh::addPatches(int face) {
  if (!factory_.FaceHasLimitSurface(face)) return;
  const int size = refiner_.GetLevel(0).GetFaceVertices(face).size();
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

void SubdivisionMesh::interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                                  int stride) const {
  const Primvar& var = primvars_[static_cast<size_t>(index)];
  const int face = patches_[patch].face;
  if (repeatIfEven(var, static_cast<size_t>(face), n, out, stride)) return;
  const Patch& p = patches_[patch];
  std::vector<float> element(static_cast<size_t>(var.width));
  const auto put = [&](int i) {
    for (int c = 0; c < var.width; ++c) out[static_cast<ptrdiff_t>(c) * stride + i] = element[static_cast<size_t>(c)];
  };
  if (crowded_.has(face) && var.storage != Storage::Varying) {
    const FaceMap map = mapOfCrowded(p);
    for (int i = 0; i < n; ++i) {
      const vec2 at = map.at(u[i], v[i]);
      crowded_.evaluate(crowdedValues_[static_cast<size_t>(index)], face, p.corner, at.x, at.y, element.data(), nullptr,
                        nullptr);
      put(i);
    }
    return;
  }
  Limit limit;
  if (var.storage == Storage::Vertex) factory_.InitVertexSurface(face, &limit.surface);
  if (var.storage == Storage::Varying) factory_.InitVaryingSurface(face, &limit.surface);
  if (var.storage == Storage::FaceVarying)
    factory_.InitFaceVaryingSurface(face, &limit.surface, channelOf_[static_cast<size_t>(index)]);
  limit.prepare(var.values.data(), var.width);
  const FaceMap map(limit.surface.GetParameterization(), p.corner);
  for (int i = 0; i < n; ++i) {
    const vec2 at = map.at(u[i], v[i]);
    limit.surface.Evaluate(&at.x, limit.points.data(), var.width, element.data());
    put(i);
  }
}

}  // namespace

PrimPtr makeSubdivisionMesh(const std::string& scheme, const std::vector<int>& vertexCounts,
                            const std::vector<int>& vertices, const SubdivisionTags& tags, const ParamList& params,
                            Problems& problems) {
  const auto type = schemeOf(scheme);
  const size_t used = requireFaces(vertexCounts, vertices);
  requireSubdividable(type == OpenSubdiv::Sdc::SCHEME_LOOP ? 3 : 0xffff, vertexCounts, vertices);
  Coarse mesh{type, vertexCounts, vertices, takePositions(params, Count::AtLeast, used, problems), {}, {}};
  const size_t vertexCount = mesh.positions.size();
  std::vector<Primvar> primvars =
      takePrimvars(params, {vertexCounts.size(), vertexCount, vertexCount, vertices.size()}, problems);
  mesh.tags = readTags(tags, EdgeFaces(vertexCounts, vertices), static_cast<int>(vertexCounts.size()),
                       static_cast<int>(vertexCount), problems);
  for (const Primvar& var : primvars)
    if (var.storage == Storage::FaceVarying) mesh.channels.push_back(mergeFaceVarying(var, vertices, vertexCount));
  if (const auto crowd = crowdBeyondMeasure(vertexCounts, vertices, vertexCount)) {
    problems.push_back(
        fmt::format("vertex {} has {} corners of faces around it, too many to be smooth: the mesh is drawn "
                    "as scheme \"bilinear\"",
                    crowd->vertex, crowd->corners));
    mesh.scheme = OpenSubdiv::Sdc::SCHEME_BILINEAR;
  }
  auto prim = std::make_shared<SubdivisionMesh>(mesh, std::move(primvars));
  if (prim->patchCount() == 0)
    problems.push_back(
        "no face has a limit surface (all are holes, or lie at a boundary without the tag "
        "\"interpolateboundary\")");
  return prim;
}

}  // namespace tomales
