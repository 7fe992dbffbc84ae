#include "raytrace/surroundings.h"

#include <cmath>

namespace tomales {

void Surroundings::reset(const vec3& origin, float reach) {
  polygons_.clear();
  origin_ = origin;
  reach_ = reach;
  known_ = true;
}

namespace {

std::array<vec3, 2> trianglesOf(const std::array<vec3, 4>& p) {
  return {cross(p[1] - p[0], p[3] - p[0]), cross(p[3] - p[2], p[1] - p[2])};
}

}  // namespace

void Surroundings::add(uint32_t group, uint32_t quad, bool flips, const std::array<vec3, 4>& corners, int instance,
                       const std::array<vec3, 4>& ofMaster) {
  const vec3 a = corners[0] - origin_, b = corners[1] - origin_, c = corners[2] - origin_, d = corners[3] - origin_;
  const std::array<vec3, 2> normals = trianglesOf({a, b, c, d});
  const std::array<float, 2> heights{dot(normals[0], a), dot(normals[1], c)};
  const float reach = 1.01f * reach_;  // grown for rounding
  const auto beyond = [&](size_t k) { return std::abs(heights[k]) > reach * glm::length(normals[k]); };
  const vec3 away = glm::max(glm::min(glm::min(a, b), glm::min(c, d)), -glm::max(glm::max(a, b), glm::max(c, d)));
  if ((beyond(0) && beyond(1)) || glm::length(glm::max(away, 0.0f)) > reach) return;
  if (polygons_.size() == kMost) return giveUp();
  Near p{group, quad, instance, flips, instance < 0 ? normals : trianglesOf(ofMaster), heights, {}, {}, {}};
  const vec3 planes[] = {cross(a, b), cross(b, d), cross(d, a), cross(b, c), cross(c, d)};
  for (size_t k = 0; k < std::size(planes); ++k) {
    p.x[k] = planes[k].x;
    p.y[k] = planes[k].y;
    p.z[k] = planes[k].z;
  }
  polygons_.push_back(p);
}

void Surroundings::meet(const vec3& direction, float window, HitList& list) const {
  for (const Near& p : polygons_) {
    alignas(32) float side[8];
    for (size_t k = 0; k < 8; ++k) side[k] = p.x[k] * direction.x + p.y[k] * direction.y + p.z[k] * direction.z;
    const auto [ab, bd, da, bc, cd, unused0, unused1, unused2] = side;
    // u and v are the weights of the corners that they lead to.
    const auto meetTriangle = [&](size_t k, float x, float u, float v) {
      if (!((x >= 0 && u >= 0 && v >= 0) || (x <= 0 && u <= 0 && v <= 0))) return;
      const float whole = x + u + v;
      if (!(std::abs(p.heights[k]) <= window * std::abs(whole)) || whole == 0) return;
      u /= whole;
      v /= whole;
      if (k == 1) {
        u = 1 - u;
        v = 1 - v;
      }
      list.push_back(
          {p.heights[k] / whole, p.group, p.quad, u, v, (whole > 0) != p.flips, p.instance, p.normals[k], -1});
    };
    meetTriangle(0, bd, da, ab);
    meetTriangle(1, -bd, bc, cd);
  }
}

}  // namespace tomales
