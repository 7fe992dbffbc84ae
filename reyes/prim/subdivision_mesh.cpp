// Subdivision surfaces by OpenSubdiv's Bfr, which evaluates the limit surface of one face from the coarse
// mesh. A patch is a quadrilateral face, or one corner's share of a face of another size.
#include <fmt/format.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/surfaceFactoryCache.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefiner.h>

#include <mutex>
#include <optional>
#include <shared_mutex>

#include "reyes/prim/bicubic.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"
#include "reyes/prim/subdivision_input.h"
#include "reyes/prim/subdivision_tags.h"

namespace tomales {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

using Refiner = std::unique_ptr<const Far::TopologyRefiner>;
using Cache = Bfr::SurfaceFactoryCacheThreaded<std::shared_mutex, std::shared_lock<std::shared_mutex>,
                                               std::unique_lock<std::shared_mutex>>;
using Factory = Bfr::RefinerSurfaceFactory<Cache>;
using Surface = Bfr::Surface<float>;

/// One patch's data, ready to evaluate.
struct Limit {
  Surface surface;
  std::vector<float> points;
  int width;

  void prepare(const float* meshValues, int valueWidth) {
    width = valueWidth;
    points.resize(static_cast<size_t>(surface.GetNumPatchPoints()) * width);
    surface.PreparePatchPoints(meshValues, width, points.data(), width);
  }
};

/// A face in a regular neighbourhood is one patch of a uniform B-spline (control points u fastest), which has
/// a faster way to be evaluated and tighter bounds. Next to a boundary or a crease Bfr repeats control points
/// for those that are not there; such faces stay with it.
std::optional<BezierPatch> asBicubic(const Limit& limit) {
  constexpr int kControls = 16;
  if (!limit.surface.IsRegular() || limit.surface.IsLinear() ||
      limit.surface.GetNumControlPoints() != kControls)
    return {};
  std::array<int, kControls> index;
  limit.surface.GetControlPointIndices(index.data());
  std::sort(index.begin(), index.end());
  if (std::adjacent_find(index.begin(), index.end()) != index.end()) return {};
  static const ToBezier kToBezier = bezierFrom(bsplineBasis());
  BezierPatch patch;
  for (int axis = 0; axis < 3; ++axis) {
    BezierNet controls;
    for (int k = 0; k < kControls; ++k) controls[k] = limit.points[static_cast<size_t>(3 * k + axis)];
    patch[axis] = convertNet(controls, kToBezier, kToBezier);
  }
  return patch;
}

/// From a patch's unit square to the coordinates of its face.
struct FaceMap {
  vec2 origin{0, 0};
  float scale = 1;
  void coordinate(float u, float v, float out[2]) const {
    out[0] = origin.x + scale * u, out[1] = origin.y + scale * v;
  }
};

FaceMap faceMap(const Surface& surface, int subFace) {
  const Bfr::Parameterization parameters = surface.GetParameterization();
  if (!parameters.HasSubFaces()) return {};
  const float zero[2] = {0, 0}, one[2] = {1, 1};
  float from[2], to[2];
  parameters.ConvertNormalizedSubFaceToCoord(subFace, zero, from);
  parameters.ConvertNormalizedSubFaceToCoord(subFace, one, to);
  return {{from[0], from[1]}, to[0] - from[0]};
}

thread_local std::string lastComplaint;

/// OpenSubdiv prints to stderr unless told otherwise; its sentence becomes part of ours.
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
  return options;
}

Sdc::SchemeType schemeOf(const std::string& scheme) {
  if (scheme == "catmull-clark") return Sdc::SCHEME_CATMARK;
  if (scheme == "bilinear") return Sdc::SCHEME_BILINEAR;
  throw PrimError(fmt::format("subdivision scheme \"{}\" is not supported", scheme));
}

/// What a mesh is made of, checked.
struct Coarse {
  Sdc::SchemeType scheme;
  const std::vector<int>& vertexCounts;
  const std::vector<int>& vertices;
  std::vector<vec3> positions;
  MeshTags tags;
  std::vector<FaceVaryingChannel> channels;
};

Refiner makeRefiner(const Coarse& mesh) {
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
  d.numVertsPerFace = mesh.vertexCounts.data(), d.vertIndicesPerFace = mesh.vertices.data();
  d.numCreases = static_cast<int>(mesh.tags.creaseSharpness.size());
  d.creaseVertexIndexPairs = mesh.tags.creaseEdges.data(), d.creaseWeights = mesh.tags.creaseSharpness.data();
  d.numCorners = static_cast<int>(mesh.tags.corners.size());
  d.cornerVertexIndices = mesh.tags.corners.data(), d.cornerWeights = mesh.tags.cornerSharpness.data();
  d.numHoles = static_cast<int>(mesh.tags.holes.size()), d.holeIndices = mesh.tags.holes.data();
  d.numFVarChannels = static_cast<int>(channels.size()), d.fvarChannels = channels.data();
  using RefinerFactory = Far::TopologyRefinerFactory<Descriptor>;
  RefinerFactory::Options options(mesh.scheme, sdcOptions(mesh.tags));
  options.validateFullTopology = true;
  Refiner refiner(RefinerFactory::Create(d, options));
  if (!refiner) throw PrimError("the faces do not make a surface: " + lastComplaint);
  return refiner;
}

class SubdivisionMesh : public Prim {
 public:
  SubdivisionMesh(const Coarse& mesh, std::vector<Primvar> primvars)
      : Prim(std::move(primvars)),
        positions_(mesh.positions),
        refiner_(makeRefiner(mesh)),
        factory_(*refiner_, Factory::Options()) {
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
  Bound3 bound(uint32_t patch, const UvRect& rect) const override;
  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override;
  void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                   int stride) const override;

 private:
  struct Patch {
    int face;
    uint16_t subFace;
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

  const std::vector<vec3> positions_;
  const Refiner refiner_;
  const Factory factory_;
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

vec3 positionAt(const Limit& limit, const FaceMap& map, float u, float v) {
  float uv[2];
  vec3 p;
  map.coordinate(u, v, uv);
  limit.surface.Evaluate(uv, limit.points.data(), 3, &p.x);
  return p;
}

struct Frame {
  vec3 p, du, dv;
};

Frame frameAt(const Limit& limit, const FaceMap& map, float u, float v) {
  float uv[2];
  Frame f;
  map.coordinate(u, v, uv);
  limit.surface.Evaluate(uv, limit.points.data(), 3, &f.p.x, &f.du.x, &f.dv.x);
  f.du *= map.scale, f.dv *= map.scale;
  return f;
}

/// The cross product of the derivatives; where they are dependent, that of a place a little nearer to the
/// middle.
vec3 normalAt(const Limit& limit, const FaceMap& map, float u, float v, const Frame& frame) {
  const auto normal = [](const Frame& f) { return cross(f.du, f.dv); };
  const auto independent = [&](const Frame& f) {
    return glm::length(normal(f)) > 1e-4f * glm::length(f.du) * glm::length(f.dv);
  };
  if (independent(frame)) return normal(frame);
  for (float step : {1e-3f, 1e-2f, 1e-1f}) {
    const Frame nearby = frameAt(limit, map, lerp(u, 0.5f, step), lerp(v, 0.5f, step));
    if (independent(nearby)) return normal(nearby);
  }
  return {0, 0, 1};
}

void SubdivisionMesh::evaluate(uint32_t patch, int n, const float* u, const float* v,
                               SurfacePoints out) const {
  const Limit limit = limitOf(patches_[patch].face);
  if (const auto bicubic = asBicubic(limit)) return evaluateBicubic(*bicubic, n, u, v, out);
  const FaceMap map = faceMap(limit.surface, patches_[patch].subFace);
  for (int i = 0; i < n; ++i) {
    const Frame f = frameAt(limit, map, u[i], v[i]);
    out.px[i] = f.p.x, out.py[i] = f.p.y, out.pz[i] = f.p.z;
    out.dux[i] = f.du.x, out.duy[i] = f.du.y, out.duz[i] = f.du.z;
    out.dvx[i] = f.dv.x, out.dvy[i] = f.dv.y, out.dvz[i] = f.dv.z;
    setNormal(out, i, normalAt(limit, map, u[i], v[i], f));
  }
}

/// Samples of the piece, grown by what it can bulge between them. A function's distance from its linear
/// interpolant is an eighth of the second difference where curvature is even; we allow four times that in
/// each direction, because next to a crease it is not.
Bound3 boundOfSamples(const Limit& limit, const FaceMap& map, const UvRect& rect) {
  constexpr int kSide = 5;
  Bound3 bound;
  vec3 p[kSide][kSide];
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const float a = static_cast<float>(i) / (kSide - 1), b = static_cast<float>(j) / (kSide - 1);
      p[j][i] = positionAt(limit, map, lerp(rect.u0, rect.u1, a), lerp(rect.v0, rect.v1, b));
      bound.extend(p[j][i]);
    }
  vec3 bendU(0), bendV(0);
  for (int j = 0; j < kSide; ++j)
    for (int i = 1; i + 1 < kSide; ++i) {
      bendU = glm::max(bendU, glm::abs(p[j][i - 1] - 2.0f * p[j][i] + p[j][i + 1]));
      bendV = glm::max(bendV, glm::abs(p[i - 1][j] - 2.0f * p[i][j] + p[i + 1][j]));
    }
  const vec3 bulge = 0.5f * (bendU + bendV);
  return {bound.lo - bulge, bound.hi + bulge};
}

/// An irregular piece lies in the box of its samples and in that of the face's control points, whose weights
/// are positive.
Bound3 SubdivisionMesh::bound(uint32_t patch, const UvRect& rect) const {
  const Limit limit = limitOf(patches_[patch].face);
  if (const auto bicubic = asBicubic(limit)) return boundBicubic(*bicubic, rect);
  Bound3 hull;
  limit.surface.BoundControlPointsFromMesh(&positions_[0].x, 3, &hull.lo.x, &hull.hi.x);
  const Bound3 sampled = boundOfSamples(limit, faceMap(limit.surface, patches_[patch].subFace), rect);
  return paddedForRounding({glm::max(hull.lo, sampled.lo), glm::min(hull.hi, sampled.hi)}, hull);
}

void SubdivisionMesh::interpolate(uint32_t patch, int index, int n, const float* u, const float* v,
                                  float* out, int stride) const {
  const Primvar& var = primvars_[static_cast<size_t>(index)];
  const int face = patches_[patch].face;
  if (var.storage == Storage::Constant) return repeatElement(var.values.data(), var.width, n, out, stride);
  if (var.storage == Storage::Uniform)
    return repeatElement(&var.values[static_cast<size_t>(face) * var.width], var.width, n, out, stride);
  Limit limit;
  if (var.storage == Storage::Vertex) factory_.InitVertexSurface(face, &limit.surface);
  if (var.storage == Storage::Varying) factory_.InitVaryingSurface(face, &limit.surface);
  if (var.storage == Storage::FaceVarying)
    factory_.InitFaceVaryingSurface(face, &limit.surface, channelOf_[static_cast<size_t>(index)]);
  limit.prepare(var.values.data(), var.width);
  const FaceMap map = faceMap(limit.surface, patches_[patch].subFace);
  std::vector<float> element(static_cast<size_t>(var.width));
  for (int i = 0; i < n; ++i) {
    float uv[2];
    map.coordinate(u[i], v[i], uv);
    limit.surface.Evaluate(uv, limit.points.data(), var.width, element.data());
    for (int c = 0; c < var.width; ++c)
      out[static_cast<ptrdiff_t>(c) * stride + i] = element[static_cast<size_t>(c)];
  }
}

}  // namespace

PrimPtr makeSubdivisionMesh(const std::string& scheme, const std::vector<int>& vertexCounts,
                            const std::vector<int>& vertices, const SubdivisionTags& tags,
                            const ParamList& params, Problems& problems) {
  listenToOpenSubdiv();
  const Sdc::SchemeType type = schemeOf(scheme);
  const size_t used = requireFaces(vertexCounts, vertices);
  requireSubdividable(vertexCounts, vertices);
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
