#include "reyes/prim/polygon_patches.h"

#include <fmt/format.h>

#include <utility>

#include "reyes/prim/edges.h"
#include "reyes/prim/face_pieces.h"
#include "reyes/prim/hole_bridges.h"

namespace tomales {
namespace {

Bound3 boundOf(const std::vector<vec3>& points) {
  Bound3 box;
  for (const vec3& p : points) box.extend(p);
  return box;
}

/// Returns a vector whose length grows with the area, or 0 where points enclose none.
glm::dvec3 areaNormal(const std::vector<vec3>& points, const Bound3& box) {
  if (points.size() < 3) return glm::dvec3(0);
  const double leastArea = 1e-9 * glm::dot(box.size(), box.size());
  glm::dvec3 normal = newellNormal(points);
  if (!(glm::length(normal) > leastArea)) normal = normalOfWidestTriangle(points);
  return glm::length(normal) > leastArea ? normal : glm::dvec3(0);
}

Face faceOf(const std::vector<vec3>& points, const glm::dvec3& normal, const Bound3& box) {
  const glm::dvec3 unit = glm::normalize(normal);
  const double size = glm::length(glm::dvec3(box.size()));
  const bool planar = std::none_of(points.begin(), points.end(), [&](const vec3& p) {
    return std::abs(glm::dot(glm::dvec3(p - points[0]), unit)) > 1e-6 * size;
  });
  return {vec3(unit), planar};
}

class Decomposer {
 public:
  Decomposer(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts, const std::vector<int>& vertices,
             const std::vector<vec3>& positions, const PointKeys& keys)
      : loopCounts_(loopCounts),
        vertexCounts_(vertexCounts),
        vertices_(vertices),
        positions_(positions),
        edges_(vertexCounts, vertices) {
    for (const std::vector<vec3>& key : keys)
      if (key.size() == positions.size()) keys_.push_back(&key);
    if (keys_.empty()) keys_.push_back(&positions);
  }

  Decomposition run(Problems& problems) {
    uint32_t first = 0;
    size_t dropped = 0, loop = 0;
    out_.faces.reserve(loopCounts_.size());
    out_.patches.reserve(loopCounts_.size());
    for (const int loops : loopCounts_) {
      const std::span<const int> counts(&vertexCounts_[loop], static_cast<size_t>(loops));
      dropped += !addFace(first, counts);
      for (const int count : counts) first += static_cast<uint32_t>(count);
      loop += counts.size();
    }
    if (dropped)
      problems.push_back(fmt::format("{} of {} faces have no area; they were dropped", dropped, loopCounts_.size()));
    if (holesIgnored_)
      problems.push_back(fmt::format("{} holes lie outside of their polygon; they were ignored", holesIgnored_));
    if (overlapping_)
      problems.push_back(fmt::format("{} faces turn inside out as they move and overlap themselves", overlapping_));
    return std::move(out_);
  }

 private:
  using Points = std::vector<vec3>;

  vec3 position(const Points& key, uint32_t faceVertex) const {
    return key[static_cast<size_t>(vertices_[faceVertex])];
  }

  bool coincide(uint32_t a, uint32_t b) const {
    return std::all_of(keys_.begin(), keys_.end(),
                       [&](const Points* key) { return position(*key, a) == position(*key, b); });
  }

  const Points& cornersAt(const Points& key) {
    points_.clear();
    for (const uint32_t c : corner_) points_.push_back(position(key, c));
    return points_;
  }

  /// Adds a loop's vertices without those that repeat the one before.
  void gather(uint32_t first, uint32_t count) {
    loopStart_.push_back(static_cast<int>(corner_.size()));
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t next = first + (k + 1) % count;
      if (coincide(first + k, next)) continue;
      // This is the corner's edge to the next one; the last of several equal vertices has it.
      corner_.push_back(first + k);
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

  /// Return the face-vertex at a position among the corners, and whether its edge to the next one is open.
  uint32_t cornerAt(int k) const { return corner_[static_cast<size_t>(k)]; }
  bool openAt(int k) const { return open_[static_cast<size_t>(k)] != 0; }
  int nextInLoop(int k) const {
    const auto end = std::upper_bound(loopStart_.begin(), loopStart_.end(), k);
    return k + 1 < *end ? k + 1 : *(end - 1);
  }

  /// Joins the loops to one closed walk. A bridge is never open.
  void joinHoles() {
    const BridgedOutline outline = bridgeHoles(outlines_, loopStart_);
    holesIgnored_ += static_cast<size_t>(outline.ignored);
    disjoint_ = outline.simple;
    std::vector<uint32_t> corner;
    std::vector<char> open;
    for (size_t k = 0; k < outline.order.size(); ++k) {
      const int at = static_cast<int>(outline.order[k]),
                to = static_cast<int>(outline.order[(k + 1) % outline.order.size()]);
      corner.push_back(cornerAt(at));
      open.push_back(nextInLoop(at) == to ? openAt(at) : nextInLoop(to) == at && openAt(to));
    }
    for (std::vector<Point2>& p : outlines_) {
      const std::vector<Point2> loops = std::exchange(p, {});
      for (const uint32_t at : outline.order) p.push_back(loops[at]);
    }
    corner_ = std::move(corner);
    open_ = std::move(open);
  }

  glm::dvec3 normalAt(const Points& key) {
    const Points& points = cornersAt(key);
    return areaNormal(points, boundOf(points));
  }

  /// Finds the outline's normals at the keys, and that of the current key; if it has no area there, that of the first
  /// key where it has. Returns false if it never has.
  bool findNormals() {
    normals_.clear();
    for (const Points* key : keys_) normals_.push_back(normalAt(*key));
    const auto any =
        std::find_if(normals_.begin(), normals_.end(), [](const glm::dvec3& n) { return n != glm::dvec3(0); });
    if (any == normals_.end()) return false;
    normal_ = keys_[0] == &positions_ ? normals_[0] : normalAt(positions_);
    if (normal_ == glm::dvec3(0)) normal_ = *any;
    return true;
  }

  void projectLoops() {
    outlines_.clear();
    for (size_t k = 0; k < keys_.size(); ++k)
      if (normals_[k] != glm::dvec3(0)) outlines_.push_back(projected(cornersAt(*keys_[k]), normals_[k]));
  }

  bool addFace(uint32_t first, std::span<const int> counts) {
    corner_.clear();
    open_.clear();
    loopStart_.clear();
    disjoint_ = true;
    gather(first, static_cast<uint32_t>(counts[0]));
    out_.faces.push_back({vec3(0), true});
    if (!findNormals()) return false;
    if (counts.size() > 1) gatherHoles(first + static_cast<uint32_t>(counts[0]), counts.subspan(1));
    const Points& points = cornersAt(positions_);
    out_.faces.back() = faceOf(points, normal_, boundOf(points));
    if (corner_.size() == 3) {
      addTriangle({0, 1, 2});
      return true;
    }
    projectLoops();
    if (counts.size() > 1) joinHoles();
    if (corner_.size() == 4 && isStrictlyConvex(outlines_)) {
      addQuad({corner_[0], corner_[1], corner_[3], corner_[2]},
              {out_.faces.back().planar, edgeBits(open_[3], open_[1], open_[0], open_[2])});
      return true;
    }
    const Pieces pieces = convexPieces(outlines_);
    for (const Piece& piece : pieces.list) addPiece(piece);
    overlapping_ += !(disjoint_ && pieces.disjoint);
    return true;
  }

  static uint8_t edgeBits(bool u0, bool u1, bool v0, bool v1) {
    return static_cast<uint8_t>(u0 * kEdgeU0 | u1 * kEdgeU1 | v0 * kEdgeV0 | v1 * kEdgeV1);
  }

  void addQuad(const Corners& corners, const PatchInfo& info) {
    out_.patches.add({corners, static_cast<uint32_t>(out_.faces.size() - 1), info});
  }

  /// Makes a mean of face-vertices, and returns its index.
  uint32_t make(std::span<const uint32_t> from) {
    out_.made.add(from);
    return static_cast<uint32_t>(vertices_.size() + out_.made.count() - 1);
  }

  bool openBetween(int a, int b) const { return (a + 1) % static_cast<int>(corner_.size()) == b && openAt(a); }

  /// Adds a triangle as one patch. Its edge v = 1 is the corner opposite to its shortest side, so that lines along u
  /// are short. A function that is linear over the triangle is also linear over the patch.
  void addTriangle(const Piece& piece) {
    const auto side = [&](size_t k) {
      const vec3 d = position(*keys_[0], cornerAt(piece[(k + 1) % 3])) - position(*keys_[0], cornerAt(piece[k]));
      return glm::dot(d, d);
    };
    const size_t k = side(1) < side(0) ? (side(2) < side(1) ? 2 : 1) : (side(2) < side(0) ? 2 : 0);
    const int a = piece[k], b = piece[(k + 1) % 3], c = piece[(k + 2) % 3];
    addQuad({cornerAt(a), cornerAt(b), cornerAt(c), cornerAt(c)},
            {true, edgeBits(openBetween(c, a), openBetween(b, c), openBetween(a, b), true)});
  }

  void addPiece(const Piece& piece) {
    const size_t n = piece.size();
    if (n == 3) return addTriangle(piece);
    std::vector<uint32_t>&at = at_, &middle = middle_;
    at.clear();
    middle.clear();
    for (int k : piece) at.push_back(cornerAt(k));
    for (size_t k = 0; k < n; ++k) middle.push_back(make(std::array{at[k], at[(k + 1) % n]}));
    const uint32_t center = make(at);
    const bool planar = out_.faces.back().planar;
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
  std::vector<const std::vector<vec3>*> keys_;  ///< The keys by which faces are cut; never empty.
  const EdgeFaces edges_;
  Decomposition out_;
  size_t holesIgnored_ = 0, overlapping_ = 0;
  std::vector<uint32_t> corner_;     // Corners of the current face.
  Points points_;                    // Positions of its corners at some key.
  std::vector<glm::dvec3> normals_;  // Indexed by key.
  glm::dvec3 normal_{0};
  Outlines outlines_;
  bool disjoint_ = true;
  std::vector<char> open_;             // Indexed by corner: true if its edge to the next one is open.
  std::vector<int> loopStart_;         // Index of the first corner of every loop, and the end.
  std::vector<uint32_t> at_, middle_;  // Vertices of the current piece.
};

}  // namespace

Decomposition decompose(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts,
                        const std::vector<int>& vertices, const std::vector<vec3>& positions, const PointKeys& keys,
                        Problems& problems) {
  return Decomposer(loopCounts, vertexCounts, vertices, positions, keys).run(problems);
}

}  // namespace tomales
