#include "gi/photons/tree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr uint32_t kLeaf = 16;
constexpr float kSameSide = 0.5f;      ///< Photons on surfaces turned away by more than 60 degrees do not count.
constexpr float kAlongNormal = 15.0f;  ///< A photon off the plane counts as if it were four times as far off.
/// A photon of another surface counts as if it were four hundred times as far off the plane: tiles of one floor
/// continue each other, a ball does not continue the floor it lies on. The height is measured along the mean of both
/// normals, so two places of one sphere or plane have none, and two parallel surfaces have.
constexpr float kOffSheet = 160e3f;

/// Puts photons into this order in place, cycle by cycle, with one photon held aside. A copy of all would be the peak
/// of the memory of estimates.
void reorder(PointCloud& photons, std::vector<uint32_t> order) {
  const auto width = static_cast<size_t>(photons.width());
  std::vector<float> data(width);
  const auto valuesOf = [&](size_t i) { return photons.data.begin() + static_cast<ptrdiff_t>(i * width); };
  for (uint32_t start = 0; start < order.size(); ++start) {
    const vec3 position = photons.position[start], normal = photons.normal[start];
    const float radius = photons.radius[start];
    std::copy_n(valuesOf(start), width, data.begin());
    uint32_t to = start;
    for (uint32_t from; (from = std::exchange(order[to], to)) != start; to = from) {
      photons.position[to] = photons.position[from];
      photons.normal[to] = photons.normal[from];
      photons.radius[to] = photons.radius[from];
      std::copy_n(valuesOf(from), width, valuesOf(to));
    }
    photons.position[to] = position;
    photons.normal[to] = normal;
    photons.radius[to] = radius;
    std::copy_n(data.begin(), width, valuesOf(to));
  }
}

}  // namespace

PhotonTree::PhotonTree(PointCloud photons) : photons_(std::move(photons)) {
  std::vector<uint32_t> order(photons_.count());
  std::iota(order.begin(), order.end(), 0u);
  build(order, 0, static_cast<uint32_t>(order.size()), 0);
  reorder(photons_, std::move(order));
  surface_.reserve(photons_.count());
  for (size_t i = 0; i < photons_.count(); ++i) surface_.push_back(static_cast<uint8_t>(photons_.surface(i)));
}

void PhotonTree::build(std::vector<uint32_t>& order, uint32_t begin, uint32_t end, uint32_t node) {
  throwIfStopped();
  if (end - begin <= kLeaf) return;
  Bound3 bound;
  for (uint32_t i = begin; i < end; ++i) bound.extend(position(order[i]));
  const vec3 size = bound.size();
  const int axis = longestAxis(size);
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end, [&](uint32_t a, uint32_t b) {
    const float pa = position(a)[axis], pb = position(b)[axis];
    return pa != pb ? pa < pb : a < b;
  });
  if (splits_.size() <= node) splits_.resize(node + 1);
  splits_[node] = {position(order[middle])[axis], axis};
  build(order, begin, middle, 2 * node + 1);
  build(order, middle, end, 2 * node + 2);
}

float PhotonTree::distance2(uint32_t i, const vec3& P, const vec3& N, int surface) const {
  if (N != vec3(0.0f) && dot(normal(i), N) < kSameSide) return kInfinity;
  const vec3 off = position(i) - P;
  const bool same = surface == 0 || surface_[i] == 0 || surface_[i] == surface;
  const float apart = same ? dot(off, N) : 0.5f * dot(off, N + normal(i));
  return dot(off, off) + (same ? kAlongNormal : kOffSheet) * apart * apart;
}

void PhotonTree::nearest(const vec3& P, const vec3& N, int surface, size_t most, float radius,
                         std::vector<NearPhoton>& heap) const {
  struct Range {
    uint32_t begin, end, node;
    float distance2;
  };
  heap.clear();
  float limit = radius * radius;
  std::array<Range, 64> stack;
  size_t depth = 0;
  stack[depth++] = {0, static_cast<uint32_t>(photons_.count()), 0, 0};
  while (depth > 0) {
    Range r = stack[--depth];
    if (r.distance2 > limit) continue;
    while (r.end - r.begin > kLeaf) {
      const Split& split = splits_[r.node];
      const uint32_t middle = r.begin + (r.end - r.begin) / 2;
      const float d = P[split.axis] - split.at;
      const Range low{r.begin, middle, 2 * r.node + 1, r.distance2}, high{middle, r.end, 2 * r.node + 2, r.distance2};
      Range& far = stack[depth++];
      far = d < 0 ? high : low;
      far.distance2 = std::max(r.distance2, d * d);
      r = d < 0 ? low : high;
    }
    for (uint32_t i = r.begin; i < r.end; ++i) {
      const float to = distance2(i, P, N, surface);
      if (!(to <= limit)) continue;
      heap.push_back({to, i});
      std::push_heap(heap.begin(), heap.end());
      if (heap.size() > most) {
        std::pop_heap(heap.begin(), heap.end());
        heap.pop_back();
      }
      if (heap.size() == most) limit = heap.front().distance2;
    }
  }
}

}  // namespace tomales
