#include "reyes/rib/closed_surface.h"

#include <algorithm>
#include <array>
#include <map>

namespace tomales::rib {
namespace {

constexpr int kPoints = 17;          ///< Number of points on an edge.
constexpr float kTolerance = 0.01f;  ///< A share of the whole; 16 chords leave a circle by 0.7 % of its diameter.
constexpr size_t kMostEdges = 2000;

/// Runs around the patch so that its surface lies on the left, as seen from where its normals point to.
struct EdgeLine {
  std::array<vec3, kPoints> at;
  Bound3 bound;
  size_t object;
};

EdgeLine edgeLine(const Object& o, size_t number, uint32_t patch, PatchEdge edge) {
  float u[kPoints], v[kPoints], data[12][kPoints];
  for (int i = 0; i < kPoints; ++i) {
    const float along = static_cast<float>(i) / (kPoints - 1);
    u[i] = edge == kEdgeU0 ? 0.0f : edge == kEdgeU1 ? 1.0f : along;
    v[i] = edge == kEdgeV0 ? 0.0f : edge == kEdgeV1 ? 1.0f : along;
  }
  o.shape().evaluate(
      patch, kPoints, u, v,
      {data[0], data[1], data[2], data[3], data[4], data[5], data[6], data[7], data[8], data[9], data[10], data[11]});
  EdgeLine line;
  line.object = number;
  for (size_t i = 0; i < kPoints; ++i) {
    line.at[i] = transformPoint(o.worldFromObject.keys.front(), {data[0][i], data[1][i], data[2][i]});
    line.bound.extend(line.at[i]);
  }
  const bool mirrors = glm::determinant(mat3(o.worldFromObject.keys.front())) < 0;
  if ((edge == kEdgeU0 || edge == kEdgeV1) != (mirrors != o.attributes->insideOut))
    std::reverse(line.at.begin(), line.at.end());
  return line;
}

float distance2(const vec3& p, const vec3& a, const vec3& b) {
  const vec3 along = b - a, from = p - a;
  const float length2 = dot(along, along);
  const float t = length2 > 0 ? std::clamp(dot(from, along) / length2, 0.0f, 1.0f) : 0.0f;
  const vec3 off = from - t * along;
  return dot(off, off);
}

bool near(const EdgeLine& line, const vec3& p, float tolerance) {
  const Bound3 b = line.bound.grown(tolerance);
  return !glm::any(glm::lessThan(p, b.lo)) && !glm::any(glm::greaterThan(p, b.hi));
}

bool passes(const EdgeLine& line, const vec3& p, float tolerance) {
  if (!near(line, p, tolerance)) return false;
  for (size_t i = 0; i + 1 < kPoints; ++i)
    if (distance2(p, line.at[i], line.at[i + 1]) <= tolerance * tolerance) return true;
  return false;
}

bool joined(const EdgeLine& line, const std::vector<EdgeLine>& all, float tolerance) {
  if (glm::length(line.bound.size()) <= tolerance) return true;  // the edge is a pole
  return std::all_of(line.at.begin(), line.at.end(), [&](const vec3& p) {
    return std::any_of(all.begin(), all.end(),
                       [&](const EdgeLine& o) { return &o != &line && passes(o, p, tolerance); });
  });
}

struct Edges {
  std::vector<EdgeLine> lines;
  float tolerance = 0;
};

/// Returns no lines if there are too many to compare.
Edges edgesOf(std::span<const Object> objects) {
  Edges edges;
  Bound3 whole;
  for (size_t i = 0; i < objects.size(); ++i)
    for (uint32_t patch = 0; patch < objects[i].shape().patchCount(); ++patch) {
      const Object& o = objects[i];
      whole.extend(transformBound(o.worldFromObject.keys.front(), o.shape().bound(patch, UvRect{})));
      for (const PatchEdge edge : {kEdgeU0, kEdgeU1, kEdgeV0, kEdgeV1})
        if (o.shape().info(patch).openEdges & edge) edges.lines.push_back(edgeLine(o, i, patch, edge));
      if (edges.lines.size() > kMostEdges) return {};
    }
  edges.tolerance = kTolerance * glm::length(whole.size());
  return edges;
}

using Votes = std::map<std::pair<size_t, size_t>, int>;  ///< Indexed by the numbers of two objects.

/// Adds 1 for each chord beside which the nearest edge of another object runs in the same direction, and -1 where it
/// runs in the other, to the votes on these two objects.
void compareDirections(const EdgeLine& line, const Edges& edges, Votes& votes) {
  for (size_t i = 0; i + 1 < kPoints; ++i) {
    const vec3 along = line.at[i + 1] - line.at[i], middle = 0.5f * (line.at[i] + line.at[i + 1]);
    float nearest = edges.tolerance * edges.tolerance, cosine = 0;
    const EdgeLine* other = nullptr;
    for (const EdgeLine& e : edges.lines) {
      if (e.object == line.object || !near(e, middle, edges.tolerance)) continue;
      for (size_t k = 0; k + 1 < kPoints; ++k) {
        const float away = distance2(middle, e.at[k], e.at[k + 1]);
        if (away > nearest || (other && away == nearest)) continue;
        nearest = away;
        other = &e;
        cosine = dot(along, e.at[k + 1] - e.at[k]);
      }
    }
    if (other && cosine != 0) votes[{line.object, other->object}] += cosine > 0 ? 1 : -1;
  }
}

}  // namespace

const Object* findOpenEdge(std::span<const Object> objects) {
  const Edges edges = edgesOf(objects);
  for (const EdgeLine& line : edges.lines)
    if (!joined(line, edges.lines, edges.tolerance)) return &objects[line.object];
  return nullptr;
}

void findTurned(std::span<Object> objects) {
  if (objects.size() < 2) return;  // most primitives are one object, whose edges need no comparison
  const Edges edges = edgesOf(objects);
  Votes votes;
  for (const EdgeLine& line : edges.lines) compareDirections(line, edges, votes);
  std::vector<bool> known(objects.size(), false);
  std::vector<size_t> reached;
  for (size_t first = 0; first < objects.size(); ++first) {
    if (known[first]) continue;
    known[first] = true;
    reached.push_back(first);
    while (!reached.empty()) {
      const size_t from = reached.back();
      reached.pop_back();
      for (auto v = votes.lower_bound({from, 0}); v != votes.end() && v->first.first == from; ++v) {
        const size_t to = v->first.second;
        if (known[to] || v->second == 0) continue;
        known[to] = true;
        objects[to].turnedInSolid = objects[from].turnedInSolid != (v->second > 0);
        reached.push_back(to);
      }
    }
  }
}

}  // namespace tomales::rib
