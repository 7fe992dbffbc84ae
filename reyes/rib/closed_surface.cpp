#include "reyes/rib/closed_surface.h"

#include <array>

namespace tomales::rib {
namespace {

constexpr int kPoints = 17;          ///< Number of points on an edge.
constexpr float kTolerance = 0.01f;  ///< A share of the whole; 16 chords leave a circle by 0.7 % of its diameter.
constexpr size_t kMostEdges = 2000;

struct EdgeLine {
  std::array<vec3, kPoints> at;
  Bound3 bound;
  const Object* object;
};

EdgeLine edgeLine(const Object& o, uint32_t patch, PatchEdge edge) {
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
  line.object = &o;
  for (size_t i = 0; i < kPoints; ++i) {
    line.at[i] = transformPoint(o.worldFromObject.keys.front(), {data[0][i], data[1][i], data[2][i]});
    line.bound.extend(line.at[i]);
  }
  return line;
}

float distance2(const vec3& p, const vec3& a, const vec3& b) {
  const vec3 along = b - a, from = p - a;
  const float length2 = dot(along, along);
  const float t = length2 > 0 ? std::clamp(dot(from, along) / length2, 0.0f, 1.0f) : 0.0f;
  const vec3 off = from - t * along;
  return dot(off, off);
}

bool passes(const EdgeLine& line, const vec3& p, float tolerance) {
  const Bound3 near = line.bound.grown(tolerance);
  if (glm::any(glm::lessThan(p, near.lo)) || glm::any(glm::greaterThan(p, near.hi))) return false;
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

}  // namespace

const Object* findOpenEdge(std::span<const Object> objects) {
  std::vector<EdgeLine> lines;
  Bound3 whole;
  for (const Object& o : objects)
    for (uint32_t patch = 0; patch < o.shape().patchCount(); ++patch) {
      whole.extend(transformBound(o.worldFromObject.keys.front(), o.shape().bound(patch, UvRect{})));
      for (const PatchEdge edge : {kEdgeU0, kEdgeU1, kEdgeV0, kEdgeV1})
        if (o.shape().info(patch).openEdges & edge) lines.push_back(edgeLine(o, patch, edge));
      if (lines.size() > kMostEdges) return nullptr;
    }
  const float tolerance = kTolerance * glm::length(whole.size());
  for (const EdgeLine& line : lines)
    if (!joined(line, lines, tolerance)) return line.object;
  return nullptr;
}

}  // namespace tomales::rib
