#include "reyes/bindings/assimp/smooth_normals.h"

namespace tomales::model {
namespace {

/// If more faces than this meet at a point, all of them count, whatever their angles, because the work would grow with
/// the square of their number.
constexpr int kMostCompared = 64;

const vec3 kNone(0.0f);

/// Returns the face's normal, or zero if it has no area. Newell's method also works for polygons that are not quite
/// flat.
vec3 faceNormal(const std::vector<vec3>& points, const int* corners, int count) {
  glm::dvec3 sum(0.0);
  const glm::dvec3 origin = points[static_cast<size_t>(corners[0])];
  for (int k = 1; k + 1 < count; ++k)
    sum += glm::cross(glm::dvec3(points[static_cast<size_t>(corners[k])]) - origin,
                      glm::dvec3(points[static_cast<size_t>(corners[k + 1])]) - origin);
  const double length = glm::length(sum);
  return length > 0 && std::isfinite(length) ? vec3(sum / length) : kNone;
}

float angleAt(const std::vector<vec3>& points, const int* corners, int count, int k) {
  const auto at = [&](int i) { return points[static_cast<size_t>(corners[(i + count) % count])]; };
  const vec3 a = normalizeOr(at(k - 1) - at(k), kNone), b = normalizeOr(at(k + 1) - at(k), kNone);
  return std::acos(glm::clamp(dot(a, b), -1.0f, 1.0f));
}

}  // namespace

std::vector<vec3> smoothNormals(const std::vector<vec3>& points, const std::vector<int>& counts,
                                const std::vector<int>& corners, float crease_degrees) {
  std::vector<vec3> normal(corners.size()), weighted(corners.size());  // of each corner's face
  size_t first = 0;
  for (const int count : counts) {
    const int* face = corners.data() + first;
    const vec3 n = faceNormal(points, face, count);
    for (int k = 0; k < count; ++k, ++first) {
      normal[first] = n;
      weighted[first] = angleAt(points, face, count, k) * n;
    }
  }
  std::vector<int> begin(points.size() + 1, 0), around(corners.size());  // corners by point
  for (const int p : corners) ++begin[static_cast<size_t>(p) + 1];
  for (size_t p = 0; p < points.size(); ++p) begin[p + 1] += begin[p];
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for (size_t c = 0; c < corners.size(); ++c)
    around[static_cast<size_t>(next[static_cast<size_t>(corners[c])]++)] = static_cast<int>(c);

  const float crease = std::cos(glm::radians(crease_degrees));
  std::vector<vec3> out(corners.size());
  for (size_t p = 0; p < points.size(); ++p) {
    const bool compared = begin[p + 1] - begin[p] <= kMostCompared;
    vec3 all = kNone;
    for (int k = begin[p]; k < begin[p + 1]; ++k) all += weighted[static_cast<size_t>(around[static_cast<size_t>(k)])];
    for (int k = begin[p]; k < begin[p + 1]; ++k) {
      const auto corner = static_cast<size_t>(around[static_cast<size_t>(k)]);
      vec3 sum = compared ? kNone : all;
      for (int j = begin[p]; compared && j < begin[p + 1]; ++j) {
        const auto other = static_cast<size_t>(around[static_cast<size_t>(j)]);
        if (dot(normal[corner], normal[other]) >= crease) sum += weighted[other];
      }
      out[corner] = normalizeOr(sum, normalizeOr(normal[corner], vec3(0, 1, 0)));
    }
  }
  return out;
}

}  // namespace tomales::model
