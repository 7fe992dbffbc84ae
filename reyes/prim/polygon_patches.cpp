#include "reyes/prim/polygon_patches.h"

#include <fmt/format.h>

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

/// As long as the area is large, or 0 where points enclose none.
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
  Decomposer(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts,
             const std::vector<int>& vertices, const std::vector<vec3>& plan, const std::vector<vec3>& positions)
      : loopCounts_(loopCounts),
        vertexCounts_(vertexCounts),
        vertices_(vertices),
        plan_(plan),
        positions_(positions),
        edges_(vertexCounts, vertices) {}

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
      problems.push_back(
          fmt::format("{} of {} faces have no area; they were dropped", dropped, loopCounts_.size()));
    if (holesIgnored_)
      problems.push_back(
          fmt::format("{} holes lie outside of their polygon; they were ignored", holesIgnored_));
    return std::move(out_);
  }

 private:
  vec3 position(uint32_t faceVertex) const { return plan_[static_cast<size_t>(vertices_[faceVertex])]; }

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
    const Bound3 box = boundOf(point_);
    const glm::dvec3 normal = areaNormal(point_, box);
    out_.faces.push_back({vec3(0), true});
    if (normal == glm::dvec3(0)) return false;
    if (counts.size() > 1) {
      gatherHoles(first + static_cast<uint32_t>(counts[0]), counts.subspan(1));
      joinHoles(normal);
    }
    out_.faces.back() = faceOf(point_, normal, box);
    if (&plan_ != &positions_) moveFace();
    if (point_.size() == 3)
      addPiece({0, 1, 2});
    else if (point_.size() == 4 && isStrictlyConvex(point_, normal))
      addQuad({corner_[0], corner_[1], corner_[3], corner_[2]},
              {out_.faces.back().planar, edgeBits(open_[3], open_[1], open_[0], open_[2])});
    else
      for (const Piece& piece : convexPieces(point_, normal)) addPiece(piece);
    return true;
  }

  /// The face at hand where its corners are in `positions_`. Without area there it keeps the plane of the plan.
  void moveFace() {
    std::vector<vec3> moved;
    for (const uint32_t c : corner_) moved.push_back(positions_[static_cast<size_t>(vertices_[c])]);
    const Bound3 box = boundOf(moved);
    const glm::dvec3 normal = areaNormal(moved, box);
    out_.faces.back() = faceOf(moved, normal == glm::dvec3(0) ? glm::dvec3(out_.faces.back().normal) : normal, box);
  }

  static uint8_t edgeBits(bool u0, bool u1, bool v0, bool v1) {
    return static_cast<uint8_t>(u0 * kEdgeU0 | u1 * kEdgeU1 | v0 * kEdgeV0 | v1 * kEdgeV1);
  }

  void addQuad(const Corners& corners, const PatchInfo& info) {
    out_.patches.add({corners, static_cast<uint32_t>(out_.faces.size() - 1), info});
  }

  /// The number that a mean of face-vertices gets.
  uint32_t make(std::span<const uint32_t> from) {
    out_.made.add(from);
    return static_cast<uint32_t>(vertices_.size() + out_.made.count() - 1);
  }

  bool openBetween(int a, int b) const { return (a + 1) % static_cast<int>(corner_.size()) == b && open_[a]; }

  /// One patch, of which the edge v = 1 is the corner that its shortest side faces: lines along u are short, and what is linear over the
  /// triangle is so over the patch.
  void addTriangle(const Piece& piece) {
    const auto side = [&](size_t k) {
      const vec3 d = point_[static_cast<size_t>(piece[(k + 1) % 3])] - point_[static_cast<size_t>(piece[k])];
      return glm::dot(d, d);
    };
    const size_t k = side(1) < side(0) ? (side(2) < side(1) ? 2 : 1) : (side(2) < side(0) ? 2 : 0);
    const int a = piece[k], b = piece[(k + 1) % 3], c = piece[(k + 2) % 3];
    addQuad({corner_[a], corner_[b], corner_[c], corner_[c]},
            {true, edgeBits(openBetween(c, a), openBetween(b, c), openBetween(a, b), true)});
  }

  void addPiece(const Piece& piece) {
    const size_t n = piece.size();
    if (n == 3) return addTriangle(piece);
    std::vector<uint32_t>&at = at_, &middle = middle_;
    at.clear(), middle.clear();
    for (int k : piece) at.push_back(corner_[k]);
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
  const std::vector<vec3>&plan_, &positions_;
  const EdgeFaces edges_;
  Decomposition out_;
  size_t holesIgnored_ = 0;
  std::vector<uint32_t> corner_;  // of the face at hand
  std::vector<vec3> point_;
  std::vector<char> open_;      // edge from a corner to the next
  std::vector<int> loopStart_;  // first corner of every loop, and the end
  std::vector<uint32_t> at_, middle_;  // of the piece at hand
};

}  // namespace

Decomposition decompose(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts,
                        const std::vector<int>& vertices, const std::vector<vec3>& plan, const std::vector<vec3>& positions,
                        Problems& problems) {
  return Decomposer(loopCounts, vertexCounts, vertices, plan, positions).run(problems);
}

}  // namespace tomales
