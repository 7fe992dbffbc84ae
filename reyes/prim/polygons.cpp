// Polygons as bilinear patches. A convex quadrilateral is one patch; every other face becomes quadrilaterals
// around the centres of its convex pieces, which meet at the midpoints of the edges.
#include <fmt/format.h>

#include <span>

#include "reyes/prim/edges.h"
#include "reyes/prim/face_pieces.h"
#include "reyes/prim/hole_bridges.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"

namespace tomales {
namespace {

/// Corners are numbered by face-vertex: the RIB's own first, then made points. Made point k is also vertex
/// number (vertices of the RIB) + k.
struct QuadPatch {
  Corners corners;
  uint32_t face;
  PatchInfo info;
};

struct Face {
  vec3 normal;
  bool planar;
};

/// Points made as the means of face-vertices. Flat, because a mesh of triangles makes four points a face.
class MadePoints {
 public:
  size_t count() const { return ends_.size(); }
  void add(std::span<const uint32_t> from) {
    sources_.insert(sources_.end(), from.begin(), from.end());
    ends_.push_back(sources_.size());
  }
  std::span<const uint32_t> sources(size_t k) const {
    const size_t begin = k ? ends_[k - 1] : 0;
    return {&sources_[begin], ends_[k] - begin};
  }

 private:
  std::vector<uint32_t> sources_;
  std::vector<size_t> ends_;
};

struct Decomposition {
  std::vector<Face> faces;  ///< By RIB face.
  std::vector<QuadPatch> patches;
  MadePoints made;
};

class Decomposer {
 public:
  /// A face is a run of loops: its outline and its holes.
  Decomposer(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts,
             const std::vector<int>& vertices, const std::vector<vec3>& positions)
      : loopCounts_(loopCounts),
        vertexCounts_(vertexCounts),
        vertices_(vertices),
        positions_(positions),
        edges_(vertexCounts, vertices) {}

  Decomposition run(Problems& problems) {
    uint32_t first = 0;
    size_t dropped = 0, loop = 0;
    for (const int loops : loopCounts_) {
      const std::span<const int> counts(&vertexCounts_[loop], static_cast<size_t>(loops));
      dropped += !addFace(first, counts);
      for (const int count : counts) first += static_cast<uint32_t>(count);
      loop += counts.size();
    }
    if (dropped)
      problems.push_back(
          fmt::format("{} of {} faces have no area; they were dropped", dropped, loopCounts_.size()));
    if (holesIgnored_)
      problems.push_back(
          fmt::format("{} holes lie outside of their polygon; they were ignored", holesIgnored_));
    return std::move(out_);
  }

 private:
  vec3 position(uint32_t faceVertex) const { return positions_[static_cast<size_t>(vertices_[faceVertex])]; }

  /// A loop's vertices without those that repeat the one before.
  void gather(uint32_t first, uint32_t count) {
    loopStart_.push_back(static_cast<int>(corner_.size()));
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t next = first + (k + 1) % count;
      if (position(first + k) == position(next)) continue;
      // This corner's edge to the next one; the last of several equal vertices carries it.
      corner_.push_back(first + k), point_.push_back(position(first + k));
      open_.push_back(edges_.count(vertices_[first + k], vertices_[next]) < 2);
    }
  }

  void gatherHoles(uint32_t first, std::span<const int> counts) {
    for (const int count : counts) {
      gather(first, static_cast<uint32_t>(count));
      first += static_cast<uint32_t>(count);
    }
    loopStart_.push_back(static_cast<int>(corner_.size()));
  }

  int nextInLoop(int k) const {
    const auto end = std::upper_bound(loopStart_.begin(), loopStart_.end(), k);
    return k + 1 < *end ? k + 1 : *(end - 1);
  }

  /// Makes one closed walk of the loops. A bridge is never open.
  void joinHoles(const glm::dvec3& normal) {
    const BridgedOutline outline = bridgeHoles(point_, loopStart_, normal);
    holesIgnored_ += static_cast<size_t>(outline.ignored);
    std::vector<uint32_t> corner;
    std::vector<vec3> point;
    std::vector<char> open;
    for (size_t k = 0; k < outline.order.size(); ++k) {
      const int at = outline.order[k], to = outline.order[(k + 1) % outline.order.size()];
      corner.push_back(corner_[at]), point.push_back(point_[at]);
      open.push_back(nextInLoop(at) == to ? open_[at] : nextInLoop(to) == at ? open_[to] : 0);
    }
    corner_ = std::move(corner), point_ = std::move(point), open_ = std::move(open);
  }

  bool addFace(uint32_t first, std::span<const int> counts) {
    corner_.clear(), point_.clear(), open_.clear(), loopStart_.clear();
    gather(first, static_cast<uint32_t>(counts[0]));
    const glm::dvec3 normal = point_.size() < 3 ? glm::dvec3(0) : newellNormal(point_);
    Bound3 box;
    for (const vec3& p : point_) box.extend(p);
    const bool flatEnough =
        point_.size() >= 3 && glm::length(normal) > 1e-9 * glm::dot(box.size(), box.size());
    out_.faces.push_back({vec3(0), true});
    if (!flatEnough) return false;
    if (counts.size() > 1) {
      gatherHoles(first + static_cast<uint32_t>(counts[0]), counts.subspan(1));
      joinHoles(normal);
    }
    const glm::dvec3 unit = glm::normalize(normal);
    out_.faces.back() = {vec3(unit), isPlanar(unit, glm::length(glm::dvec3(box.size())))};
    if (point_.size() == 4 && isStrictlyConvex(point_, normal))
      addQuad({corner_[0], corner_[1], corner_[3], corner_[2]},
              {out_.faces.back().planar, edgeBits(open_[3], open_[1], open_[0], open_[2])});
    else
      for (const Piece& piece : convexPieces(point_, normal)) addPiece(piece);
    return true;
  }

  bool isPlanar(const glm::dvec3& unit, double size) const {
    for (const vec3& p : point_)
      if (std::abs(glm::dot(glm::dvec3(p - point_[0]), unit)) > 1e-6 * size) return false;
    return true;
  }

  static uint8_t edgeBits(bool u0, bool u1, bool v0, bool v1) {
    return static_cast<uint8_t>(u0 * kEdgeU0 | u1 * kEdgeU1 | v0 * kEdgeV0 | v1 * kEdgeV1);
  }

  void addQuad(const Corners& corners, const PatchInfo& info) {
    out_.patches.push_back({corners, static_cast<uint32_t>(out_.faces.size() - 1), info});
  }

  /// The number that a mean of face-vertices gets.
  uint32_t make(std::span<const uint32_t> from) {
    out_.made.add(from);
    return static_cast<uint32_t>(vertices_.size() + out_.made.count() - 1);
  }

  bool openBetween(int a, int b) const { return (a + 1) % static_cast<int>(corner_.size()) == b && open_[a]; }

  void addPiece(const Piece& piece) {
    const size_t n = piece.size();
    std::vector<uint32_t> at, middle;
    for (int k : piece) at.push_back(corner_[k]);
    for (size_t k = 0; k < n; ++k) middle.push_back(make(std::array{at[k], at[(k + 1) % n]}));
    const uint32_t center = make(at);
    const bool planar = n == 3 || out_.faces.back().planar;
    for (size_t k = 0; k < n; ++k) {
      const size_t before = (k + n - 1) % n, after = (k + 1) % n;
      const uint8_t open =
          edgeBits(openBetween(piece[before], piece[k]), false, openBetween(piece[k], piece[after]), false);
      addQuad({at[k], middle[k], middle[before], center}, {planar, open});
    }
  }

  const std::vector<int>& loopCounts_;
  const std::vector<int>& vertexCounts_;
  const std::vector<int>& vertices_;
  const std::vector<vec3>& positions_;
  const EdgeFaces edges_;
  Decomposition out_;
  size_t holesIgnored_ = 0;
  std::vector<uint32_t> corner_;  // of the face at hand
  std::vector<vec3> point_;
  std::vector<char> open_;      // edge from a corner to the next
  std::vector<int> loopStart_;  // first corner of every loop, and the end
};

class Polygons : public Prim {
 public:
  Polygons(Decomposition parts, std::vector<vec3> positions, std::vector<int> vertices,
           std::vector<Primvar> primvars)
      : Prim(std::move(primvars)),
        parts_(std::move(parts)),
        positions_(std::move(positions)),
        vertices_(std::move(vertices)) {
    addMadePoints();
  }

  uint32_t patchCount() const override { return static_cast<uint32_t>(parts_.patches.size()); }
  PatchInfo info(uint32_t patch) const override { return parts_.patches[patch].info; }
  Bound3 bound(uint32_t patch, const UvRect& rect) const override {
    return boundBilinear(cornersOf(patch), rect);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    evaluateBilinear(cornersOf(patch), n, u, v, out);
    const Face& face = parts_.faces[parts_.patches[patch].face];
    for (int i = 0; i < n; ++i)
      if (face.planar || glm::length(normalOf(out, i)) <= 1e-6f * areaScale(out, i))
        setNormal(out, i, face.normal);
  }

  /// RISpec section 5.1: the parameters of a polygon are its x and y.
  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su,
                         float* sv) const override {
    const std::array<vec3, 4> corners = cornersOf(patch);
    const float x[4] = {corners[0].x, corners[1].x, corners[2].x, corners[3].x};
    const float y[4] = {corners[0].y, corners[1].y, corners[2].y, corners[3].y};
    interpolateBilinear(x, 1, {0, 1, 2, 3}, n, u, v, su, 0);
    interpolateBilinear(y, 1, {0, 1, 2, 3}, n, u, v, sv, 0);
  }

  void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                   int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    const QuadPatch& quad = parts_.patches[patch];
    switch (var.storage) {
      case Storage::Constant:
        return repeatElement(var.values.data(), var.width, n, out, stride);
      case Storage::Uniform:
        return repeatElement(&var.values[quad.face * static_cast<size_t>(var.width)], var.width, n, out,
                             stride);
      case Storage::FaceVarying:
        return interpolateBilinear(var.values.data(), var.width, quad.corners, n, u, v, out, stride);
      default:
        return interpolateBilinear(var.values.data(), var.width, vertexNumbers(quad), n, u, v, out, stride);
    }
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
  std::array<vec3, 4> cornersOf(uint32_t patch) const {
    const Corners c = vertexNumbers(parts_.patches[patch]);
    return {positions_[c[0]], positions_[c[1]], positions_[c[2]], positions_[c[3]]};
  }

  /// Appends a value for every made point to the positions and to the primvars that have one per vertex or
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
          sum +=
              var.values[(var.storage == Storage::FaceVarying ? corner : vertexNumber(corner)) * width + c];
        var.values.push_back(sum / static_cast<float>(from.size()));
      }
  }

  Decomposition parts_;
  std::vector<vec3> positions_;
  std::vector<int> vertices_;
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
                            const std::vector<int>& vertices, const ParamList& params, Problems& problems) {
  const size_t used = requireFaces(vertexCounts, vertices);
  requireLoops(loopCounts, vertexCounts.size());
  std::vector<vec3> positions = takePositions(params, used, false, problems);
  const PrimvarCounts counts{loopCounts.size(), positions.size(), positions.size(), vertices.size()};
  std::vector<Primvar> primvars = takePrimvars(params, counts, problems);
  Decomposition parts = Decomposer(loopCounts, vertexCounts, vertices, positions).run(problems);
  return std::make_shared<Polygons>(std::move(parts), std::move(positions), vertices, std::move(primvars));
}

PrimPtr makePolygons(const std::vector<int>& vertexCounts, const std::vector<int>& vertices,
                     const ParamList& params, Problems& problems) {
  return makeGeneralPolygons(std::vector<int>(vertexCounts.size(), 1), vertexCounts, vertices, params,
                             problems);
}

}  // namespace tomales
