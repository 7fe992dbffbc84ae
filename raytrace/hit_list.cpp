#include "raytrace/hit_list.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tomales {

void sortAlongRay(HitList& list) {
  std::sort(list.begin(), list.end(), [](const PolygonHit& a, const PolygonHit& b) {
    return std::tie(a.t, a.group, a.quad) < std::tie(b.t, b.group, b.quad);
  });
}

bool sameSurface(const PolygonHit& a, const PolygonHit& b, float distance) {
  return a.leaving == b.leaving && std::abs(a.t - b.t) <= distance;
}

int effectiveOrigin(const HitList& sorted, float offset) {
  int best = -1;
  float nearest = offset;
  for (size_t i = 0; i < sorted.size(); ++i) {
    const float distance = std::abs(sorted[i].t);
    if (best < 0 ? distance <= nearest : distance < nearest) best = static_cast<int>(i), nearest = distance;
  }
  return best;
}

int nextHit(const HitList& sorted, int origin, float offset) {
  for (size_t i = static_cast<size_t>(origin + 1); i < sorted.size(); ++i) {
    const bool after = origin < 0
                           ? sorted[i].t > 0
                           : !sameSurface(sorted[static_cast<size_t>(origin)], sorted[i], mergeDistance(offset));
    if (after) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace tomales
