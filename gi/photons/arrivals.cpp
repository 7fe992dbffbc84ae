#include "gi/photons/arrivals.h"

#include <algorithm>

#include "reyes/base/morton.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr size_t kGrain = 4096;

}  // namespace

std::vector<uint32_t> mortonOrder(std::span<const vec3> points) {
  constexpr float kCells = 0x1p21f;
  Bound3 bound;
  for (const vec3& p : points) bound.extend(p);
  const vec3 cells = kCells / glm::max(bound.size(), vec3(1e-30f));
  std::vector<std::pair<uint64_t, uint32_t>> places(points.size());
  parallelFor(points.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const glm::uvec3 cell = glm::min((points[i] - bound.lo) * cells, vec3(kCells - 1));
      places[i] = {mortonPlace(cell), static_cast<uint32_t>(i)};
    }
  });
  std::sort(places.begin(), places.end());
  std::vector<uint32_t> out;
  for (const auto& [place, number] : places) out.push_back(number);
  return out;
}

PhotonArrivals::PhotonArrivals(const std::vector<StoredPhoton>& photons) {
  std::vector<vec3> places;
  for (const StoredPhoton& p : photons) places.push_back(p.P);
  for (const uint32_t i : mortonOrder(places)) photons_.push_back(photons[i]);
  boxes_.emplace_back((photons_.size() + kFan - 1) / kFan);
  parallelFor(boxes_[0].size(), kGrain / kFan, [&](size_t begin, size_t end) {
    for (size_t i = begin * kFan; i < std::min(end * kFan, photons_.size()); ++i)
      boxes_[0][i / kFan].extend(photons_[i].P);
  });
  while (boxes_.back().size() > 1) {
    const std::vector<Bound3>& below = boxes_.back();
    std::vector<Bound3> wider((below.size() + kFan - 1) / kFan);
    for (size_t i = 0; i < below.size(); ++i) wider[i / kFan].extend(below[i]);
    boxes_.push_back(std::move(wider));
  }
}

}  // namespace tomales
