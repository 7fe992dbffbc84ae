#include "reyes/rib/collapsed.h"

#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

/// Tells whether the request is a transformation that leaves nothing a volume.
bool flattens(const Request& r) {
  if (r.name == "Scale") return asVec3(r.args[0]).x * asVec3(r.args[0]).y * asVec3(r.args[0]).z == 0;
  const bool matrix = r.name == "Transform" || r.name == "ConcatTransform";
  return matrix && glm::determinant(glm::dmat4(asMatrix(r.args[0].numbers))) == 0;
}

bool isCollapsed(const Request& r) { return hasNoArea(r) || flattens(r); }

}  // namespace

Request between(Request a, const Request& b, float t) {
  for (size_t i = 0; i < a.args.size(); ++i)
    for (size_t k = 0; k < a.args[i].numbers.size(); ++k)
      a.args[i].numbers[k] = lerp(a.args[i].numbers[k], b.args[i].numbers[k], t);
  return a;
}

const char* emptyOf(const Request& r) {
  static constexpr std::string_view kMeshes[] = {"PointsPolygons", "PointsGeneralPolygons", "SubdivisionMesh",
                                                 "HierarchicalSubdivisionMesh"};
  if (r.name == "Points") {
    const Param *p = findParam(r.params, "P"), *positions = p ? p : findParam(r.params, "Pw");
    return positions && positions->floats.empty() ? "points" : nullptr;
  }
  if (r.name == "Curves") return r.args[1].integers.empty() ? "curves" : nullptr;
  if (std::find(std::begin(kMeshes), std::end(kMeshes), r.name) == std::end(kMeshes)) return nullptr;
  return r.args[r.name.ends_with("SubdivisionMesh") ? 1 : 0].integers.empty() ? "faces" : nullptr;
}

bool hasNoArea(const Request& r) {
  const Quadric* quadric = findQuadric(r.name);
  return quadric && quadric->hasNoArea(r.args[0].numbers.data());
}

std::vector<Request> grown(std::vector<Request> keys) {
  constexpr float kLittle = 1e-6f;
  const auto isWhole = [&](size_t k) { return k < keys.size() && !isCollapsed(keys[k]); };
  std::vector<Request> out = keys;
  for (size_t k = 0; k < keys.size(); ++k) {
    if (!isCollapsed(keys[k])) continue;
    for (size_t away = 1; away < keys.size(); ++away) {
      const size_t other = isWhole(k + away) ? k + away : k - away;
      if (!isWhole(other)) continue;
      out[k] = between(keys[k], keys[other], kLittle);
      break;
    }
  }
  return out;
}

}  // namespace tomales::rib
