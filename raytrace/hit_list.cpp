#include "raytrace/hit_list.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tomales {

void sortAlongRay(HitList& list) {
  if (list.size() < 2) return;
  std::sort(list.begin(), list.end(), [](const PolygonHit& a, const PolygonHit& b) {
    return std::tie(a.t, a.group, a.instance, a.chunk, a.quad) < std::tie(b.t, b.group, b.instance, b.chunk, b.quad);
  });
}

bool sameSurface(const PolygonHit& a, const PolygonHit& b, float distance) {
  return a.leaving == b.leaving && std::abs(a.t - b.t) <= distance;
}

bool isOtherFace(const PolygonHit& from, const PolygonHit& hit, const RayStart& start) {
  constexpr float kParallel = 0.9999f;  // The cosine of 0.8 degrees: both may be tessellated differently.
  if (from.leaving == hit.leaving || from.instance != hit.instance) return false;
  // Distances are measured along the normal, because a slanted ray goes farther from face to face.
  const bool isKnown = start.direction != vec3(0) && from.instance < 0;
  const float length = glm::length(from.normal), along = isKnown ? std::abs(dot(start.direction, from.normal)) : length;
  const float most = start.rounding * length;
  if (!(std::abs(from.t) * along <= most && std::abs(hit.t - from.t) * along <= most)) return false;
  return std::abs(dot(from.normal, hit.normal)) > kParallel * length * glm::length(hit.normal);
}

int effectiveOrigin(const HitList& sorted, const RayStart& start) {
  float nearest = kInfinity;
  for (const PolygonHit& hit : sorted) nearest = std::min(nearest, std::abs(hit.t));
  if (!(nearest <= start.offset)) return -1;
  const auto rank = [&](const PolygonHit& hit) {
    return std::make_tuple(static_cast<int>(hit.group) != start.group, !hit.leaving, std::abs(hit.t));
  };
  int best = -1;
  for (size_t i = 0; i < sorted.size(); ++i)
    if (std::abs(sorted[i].t) <= nearest + start.rounding &&
        (best < 0 || rank(sorted[i]) < rank(sorted[static_cast<size_t>(best)])))
      best = static_cast<int>(i);
  return best;
}

bool isCrowded(const HitList& sorted, int origin, const RayStart& start) {
  if (origin < 0 || sorted.size() < 2) return false;
  const PolygonHit& from = sorted[static_cast<size_t>(origin)];
  return std::any_of(sorted.begin(), sorted.end(), [&](const PolygonHit& hit) {
    return std::abs(hit.t) <= start.offset && hit.group == from.group && hit.leaving != from.leaving &&
           !isOtherFace(from, hit, start);
  });
}

int nextHit(const HitList& sorted, int origin, const RayStart& start) {
  const auto follows = [&](const PolygonHit& hit) {
    if (origin < 0) return hit.t > 0;
    const PolygonHit& from = sorted[static_cast<size_t>(origin)];
    return hit.t >= from.t - start.rounding && !sameSurface(from, hit, mergeDistance(start.offset)) &&
           !isOtherFace(from, hit, start);
  };
  const auto next = std::find_if(sorted.begin(), sorted.end(), follows);
  return next == sorted.end() ? -1 : static_cast<int>(next - sorted.begin());
}

}  // namespace tomales
