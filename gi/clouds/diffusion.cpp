#include "gi/clouds/diffusion.h"

#include "gi/clouds/halves.h"
#include "reyes/base/chunk_file.h"

namespace tomales {
Diffusion::Diffusion(const PointCloud& cloud) {
  const int area = offsetOf(cloud.channels, "_area", 1), light = offsetOf(cloud.channels, "_radiance_t", 3);
  if (area < 0 || light < 0)
    throw FileError(area < 0 ? "has no channel \"_area\" of 1 float" : "has no channel \"_radiance_t\" of 3 floats");
  entries_.reserve(cloud.count());
  for (size_t i = 0; i < cloud.count(); ++i) {
    const float *a = cloud.at(i) + area, *E = cloud.at(i) + light;
    entries_.push_back({cloud.position[i], *a * vec3(E[0], E[1], E[2]), *a});
  }
  if (!entries_.empty()) build(0, static_cast<uint32_t>(entries_.size()));
}

uint32_t Diffusion::build(uint32_t begin, uint32_t end) {
  const auto node = static_cast<uint32_t>(groups_.size());
  Group group{{vec3(0), vec3(0), 0}, {}, 0, begin, end, 0};
  float weights = 0;
  for (uint32_t i = begin; i < end; ++i) {
    const Entry& e = entries_[i];
    const float weight = e.flux.x + e.flux.y + e.flux.z;  // so that the group's position is where its light comes from
    group.bound.extend(e.P);
    group.all.flux += e.flux;
    group.all.area += e.area;
    group.all.P += weight * e.P;
    weights += weight;
  }
  group.all.P = weights > 0 ? group.all.P / weights : group.bound.center();
  const vec3 size = group.bound.size();
  // The area of a flat square equals half its squared diagonal, however few points it has.
  group.seen = std::max(group.all.area, 0.5f * dot(size, size));
  groups_.push_back(group);
  const auto middle = halve(entries_, begin, end, size);
  if (!middle) return node;
  build(begin, *middle);
  const uint32_t second = build(*middle, end);
  groups_[node].second = second;
  return node;
}

vec3 Diffusion::at(const vec3& P, const Dipole& dipole, float millimetres, float maxSolidAngle) const {
  const float squareMillimetres = millimetres * millimetres;
  const auto from = [&](const Entry& e) {
    const vec3 way = e.P - P;
    return squareMillimetres * e.flux * dipole.exitance(squareMillimetres * dot(way, way));
  };
  vec3 sum(0);
  uint32_t open[64];  // a tree that halves 2^32 points is no deeper
  size_t depth = 0;
  if (!groups_.empty()) open[depth++] = 0;
  while (depth > 0) {
    const uint32_t node = open[--depth];
    const Group& group = groups_[node];
    const vec3 way = group.all.P - P, outside = glm::max(glm::max(group.bound.lo - P, P - group.bound.hi), vec3(0));
    if (outside != vec3(0) && group.seen < maxSolidAngle * dot(way, way)) {
      sum += from(group.all);
    } else if (group.second != 0) {
      open[depth++] = group.second;
      open[depth++] = node + 1;
    } else {
      for (uint32_t i = group.begin; i < group.end; ++i) sum += from(entries_[i]);
    }
  }
  return sum;
}

}  // namespace tomales
