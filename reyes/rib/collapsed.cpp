#include "reyes/rib/collapsed.h"

#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

/// Of a quadric's numbers, those that must not be 0, and where two begin that must differ: so many numbers
/// each.
struct Extent {
  std::string_view name;
  std::vector<size_t> sizes;
  std::ptrdiff_t from = 0, to = 0, count = 0;
};

/// A place, or a scale, at which nothing has a volume.
bool flattens(const Request& r) {
  if (r.name == "Scale") return asVec3(r.args[0]).x * asVec3(r.args[0]).y * asVec3(r.args[0]).z == 0;
  const bool matrix = r.name == "Transform" || r.name == "ConcatTransform";
  return matrix && glm::determinant(glm::dmat4(asMatrix(r.args[0].numbers))) == 0;
}

bool isCollapsed(const Request& r) { return hasNoArea(r) || flattens(r); }

/// Where arguments of the same request stand between two keys.
Request between(Request a, const Request& b, float t) {
  for (size_t i = 0; i < a.args.size(); ++i)
    for (size_t k = 0; k < a.args[i].numbers.size(); ++k)
      a.args[i].numbers[k] = lerp(a.args[i].numbers[k], b.args[i].numbers[k], t);
  return a;
}

}  // namespace

bool isEmptyMesh(const Request& r) {
  static constexpr std::string_view kMeshes[] = {"PointsPolygons", "PointsGeneralPolygons", "SubdivisionMesh",
                                                 "HierarchicalSubdivisionMesh"};
  if (std::find(std::begin(kMeshes), std::end(kMeshes), r.name) == std::end(kMeshes)) return false;
  return r.args[r.name.ends_with("SubdivisionMesh") ? 1 : 0].integers.empty();
}

bool hasNoArea(const Request& r) {
  static const Extent kQuadrics[] = {
      {"Sphere", {0, 3}, 1, 2, 1},     {"Cone", {1, 2}}, {"Cylinder", {0, 3}, 1, 2, 1}, {"Hyperboloid", {6}, 0, 3, 3},
      {"Paraboloid", {0, 3}, 1, 2, 1}, {"Disk", {1, 2}}, {"Torus", {1, 4}, 2, 3, 1}};
  for (const Extent& e : kQuadrics) {
    if (e.name != r.name) continue;
    const std::vector<float>& n = r.args[0].numbers;
    const bool empty = e.count > 0 && std::equal(n.begin() + e.from, n.begin() + e.from + e.count, n.begin() + e.to);
    return empty || std::any_of(e.sizes.begin(), e.sizes.end(), [&](size_t i) { return n[i] == 0; });
  }
  return false;
}

std::vector<Request> grown(std::vector<Request> keys) {
  constexpr float kLittle = 1e-6f;
  const auto isWhole = [&](size_t k) { return k < keys.size() && !isCollapsed(keys[k]); };
  std::vector<Request> out = keys;
  for (size_t k = 0; k < keys.size(); ++k) {
    if (!isCollapsed(keys[k])) continue;
    for (size_t away = 1; away < keys.size(); ++away) {
      const size_t other = isWhole(k + away) ? k + away : k - away;
      if (!isWhole(other) || keys[other].name != keys[k].name) continue;
      out[k] = between(keys[k], keys[other], kLittle);
      break;
    }
  }
  return out;
}

}  // namespace tomales::rib
