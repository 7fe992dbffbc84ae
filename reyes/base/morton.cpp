#include "reyes/base/morton.h"

#include <algorithm>

#include "reyes/base/parallel.h"

namespace tomales {

std::vector<uint32_t> mortonOrder(std::span<const vec3> points) {
  constexpr size_t kGrain = 4096;
  Bound3 bound;
  for (const vec3& p : points) bound.extend(p);
  const float scale = static_cast<float>((1 << 21) - 1) / std::max(maxComponent(bound.size()), 1e-30f);
  std::vector<std::pair<uint64_t, uint32_t>> places(points.size());
  parallelFor(points.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      places[i] = {mortonPlace(glm::uvec3((points[i] - bound.lo) * scale)), static_cast<uint32_t>(i)};
  });
  std::sort(places.begin(), places.end());
  std::vector<uint32_t> out;
  for (const auto& [place, number] : places) out.push_back(number);
  return out;
}

}  // namespace tomales
