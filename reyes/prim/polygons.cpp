// Polygons (RISpec section 5.1) as bilinear patches.
#include <fmt/format.h>

#include "reyes/prim/polygon_patches.h"
#include "reyes/prim/primvars.h"

namespace tomales {
namespace {

class Polygons : public Prim {
 public:
  Polygons(Decomposition parts, std::vector<vec3> positions, std::vector<int> vertices, std::vector<Primvar> primvars)
      : Prim(std::move(primvars)),
        parts_(std::move(parts)),
        positions_(std::move(positions)),
        vertices_(std::move(vertices)) {
    findMiddles(static_cast<uint32_t>(vertices_.size()));
    addMadePoints();
  }

  uint32_t patchCount() const override { return static_cast<uint32_t>(parts_.patches.size()); }
  PatchInfo info(uint32_t patch) const override { return parts_.patches[patch].info; }
  Bound3 bound(uint32_t patch, const UvRect& rect) const override { return boundBilinear(cornersOf(patch), rect); }

  std::optional<std::array<vec3, 2>> straightEdge(uint32_t patch, PatchEdge edge) const override {
    const auto [from, to] = endsOf(parts_.patches[patch].corners, edge);
    return std::array{positions_[vertexNumber(endOf(from, to))], positions_[vertexNumber(endOf(to, from))]};
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    evaluateBilinear(cornersOf(patch), n, u, v, out);
    const Face& face = parts_.faces[parts_.patches[patch].face];
    for (int i = 0; i < n; ++i)
      if (face.planar || glm::length(normalOf(out, i)) <= 1e-6f * areaScale(out, i)) setNormal(out, i, face.normal);
  }

  /// RISpec section 5.1: the parameters of a polygon are its x and y.
  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su, float* sv) const override {
    const std::array<vec3, 4> corners = cornersOf(patch);
    const float x[4] = {corners[0].x, corners[1].x, corners[2].x, corners[3].x};
    const float y[4] = {corners[0].y, corners[1].y, corners[2].y, corners[3].y};
    interpolateBilinear(x, 1, {0, 1, 2, 3}, n, u, v, su, 0);
    interpolateBilinear(y, 1, {0, 1, 2, 3}, n, u, v, sv, 0);
  }

  void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                   int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    const QuadPatch quad = parts_.patches[patch];
    if (repeatIfEven(var, quad.face, n, out, stride)) return;
    const Corners corners = var.storage == Storage::FaceVarying ? quad.corners : vertexNumbers(quad);
    interpolateBilinear(var.values.data(), var.width, corners, n, u, v, out, stride);
  }

 private:
  static float areaScale(SurfacePoints s, int i) {
    const vec3 du(s.dux[i], s.duy[i], s.duz[i]), dv(s.dvx[i], s.dvy[i], s.dvz[i]);
    return glm::length(du) * glm::length(dv);
  }

  uint32_t vertexNumber(uint32_t faceVertex) const { return static_cast<uint32_t>(vertices_[faceVertex]); }
  Corners vertexNumbers(const QuadPatch& quad) const {
    return {vertexNumber(quad.corners[0]), vertexNumber(quad.corners[1]), vertexNumber(quad.corners[2]),
            vertexNumber(quad.corners[3])};
  }
  /// A made corner in the middle of an open edge of a face, and the ends of that edge.
  struct Middle {
    uint32_t corner;
    std::array<uint32_t, 2> ends;
    bool operator<(const Middle& other) const { return corner < other.corner; }
    bool operator==(const Middle& other) const { return corner == other.corner; }
  };
  /// Returns the corner itself or, if it is a middle, the end of its edge that is not `other`.
  uint32_t endOf(uint32_t corner, uint32_t other) const {
    const auto at = std::lower_bound(middles_.begin(), middles_.end(), Middle{corner, {}});
    if (at == middles_.end() || at->corner != corner) return corner;
    return at->ends[at->ends[0] == other ? 1 : 0];
  }

  void findMiddles(uint32_t firstMade) {
    for (size_t k = 0; k < parts_.patches.size() && parts_.made.count() > 0; ++k) {
      const QuadPatch quad = parts_.patches[k];
      for (const PatchEdge edge : {kEdgeU0, kEdgeU1, kEdgeV0, kEdgeV1}) {
        if (!(quad.info.openEdges & edge)) continue;
        for (const uint32_t corner : endsOf(quad.corners, edge)) {
          if (corner < firstMade) continue;
          const std::span<const uint32_t> ends = parts_.made.sources(corner - firstMade);
          middles_.push_back({corner, {ends[0], ends[1]}});
        }
      }
    }
    std::sort(middles_.begin(), middles_.end());
    middles_.erase(std::unique(middles_.begin(), middles_.end()), middles_.end());
  }

  std::array<vec3, 4> cornersOf(uint32_t patch) const {
    const Corners c = vertexNumbers(parts_.patches[patch]);
    return {positions_[c[0]], positions_[c[1]], positions_[c[2]], positions_[c[3]]};
  }

  /// Appends a value for every made point to the positions, and to the primvars that have one for each vertex or
  /// face-vertex.
  void addMadePoints() {
    const size_t count = parts_.made.count(), given = positions_.size();
    for (size_t k = 0; k < count; ++k) {
      const std::span<const uint32_t> from = parts_.made.sources(k);
      vec3 sum(0);
      for (uint32_t corner : from) sum += positions_[vertexNumber(corner)];
      positions_.push_back(sum / static_cast<float>(from.size()));
    }
    for (size_t k = 0; k < count; ++k) vertices_.push_back(static_cast<int>(given + k));
    for (Primvar& var : primvars_)
      if (var.storage != Storage::Constant && var.storage != Storage::Uniform) addMadeValues(var);
    parts_.made = {};
  }

  void addMadeValues(Primvar& var) const {
    const size_t width = static_cast<size_t>(var.width);
    for (size_t k = 0; k < parts_.made.count(); ++k)
      for (size_t c = 0; c < width; ++c) {
        const std::span<const uint32_t> from = parts_.made.sources(k);
        float sum = 0;
        for (uint32_t corner : from)
          sum += var.values[(var.storage == Storage::FaceVarying ? corner : vertexNumber(corner)) * width + c];
        var.values.push_back(sum / static_cast<float>(from.size()));
      }
  }

  size_t shapeBytes() const override {
    return bytesOf(parts_.faces) + parts_.patches.bytes() + bytesOf(positions_) + bytesOf(vertices_) +
           bytesOf(middles_);
  }
  Decomposition parts_;
  std::vector<vec3> positions_;
  std::vector<int> vertices_;
  std::vector<Middle> middles_;  ///< Sorted by corner.
};

void requireLoops(const std::vector<int>& loopCounts, size_t loops) {
  size_t total = 0;
  for (size_t f = 0; f < loopCounts.size(); ++f) {
    if (loopCounts[f] < 1) throw PrimError(fmt::format("face {} has {} loops", f, loopCounts[f]));
    total += static_cast<size_t>(loopCounts[f]);
  }
  if (total != loops) throw PrimError(fmt::format("the faces need {} loops and {} are given", total, loops));
}

}  // namespace

PrimPtr makeGeneralPolygons(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts,
                            const std::vector<int>& vertices, const ParamList& params, Problems& problems,
                            const PointKeys& keys) {
  const size_t used = requireFaces(vertexCounts, vertices);
  requireLoops(loopCounts, vertexCounts.size());
  std::vector<vec3> positions = takePositions(params, Count::AtLeast, used, problems);
  const PrimvarCounts counts{loopCounts.size(), positions.size(), positions.size(), vertices.size()};
  std::vector<Primvar> primvars = takePrimvars(params, counts, problems);
  // RISpec section 5.1: the normal of a face's plane is used where vertices have none of their own.
  if (offsetOf(primvars, "N") < 0)
    for (Primvar& var : primvars)
      if (var.name == "Np" && var.width == 3) var.name = "N";
  Decomposition parts = decompose(loopCounts, vertexCounts, vertices, positions, keys, problems);
  return std::make_shared<Polygons>(std::move(parts), std::move(positions), vertices, std::move(primvars));
}

PrimPtr makePolygons(const std::vector<int>& vertexCounts, const std::vector<int>& vertices, const ParamList& params,
                     Problems& problems, const PointKeys& keys) {
  return makeGeneralPolygons(std::vector<int>(vertexCounts.size(), 1), vertexCounts, vertices, params, problems, keys);
}

}  // namespace tomales
