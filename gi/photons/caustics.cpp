#include "gi/photons/caustics.h"

#include "reyes/base/check.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr size_t kFan = 8;

bool holds(const Bound3& b, const vec3& p) { return b.lo == glm::min(b.lo, p) && b.hi == glm::max(b.hi, p); }

}  // namespace

CausticPhotons::CausticPhotons(PointCloud photons, const PhotonIrradianceSettings& settings)
    : tree_(std::move(photons)),
      power_(surfacePowerOffset(tree_.photons().channels)),
      radius_(tree_.photons().count()) {
  CHECK_GE(power_, 0);
  const float reach = reachOf(settings, tree_.photons().bound());
  const auto most = static_cast<size_t>(settings.nearest) + 1;  // the photon itself is one
  parallelFor(radius_.size(), PhotonTree::kLookupsPerTask, [&](size_t begin, size_t end) {
    std::vector<NearPhoton> heap;
    for (size_t i = begin; i < end; ++i) {
      const auto at = static_cast<uint32_t>(i);
      tree_.nearest(tree_.position(at), tree_.normal(at), tree_.surface(at), most, reach, heap);
      radius_[i] = heap.size() == most ? std::sqrt(heap.front().distance2) : reach;
    }
  });
  std::vector<Bound3> level;
  for (size_t i = 0; i < radius_.size(); ++i) {
    const vec3& P = tree_.position(static_cast<uint32_t>(i));
    level.push_back({P - radius_[i], P + radius_[i]});
  }
  while (level.size() > 1 || (boxes_.empty() && !level.empty())) {
    std::vector<Bound3> wider((level.size() + kFan - 1) / kFan);
    for (size_t i = 0; i < level.size(); ++i) wider[i / kFan].extend(level[i]);
    boxes_.push_back(wider);
    level = std::move(wider);
  }
}

/// Calls f for the photons of a box whose own boxes may hold P.
template <class Visit>
void CausticPhotons::visit(size_t level, size_t box, const vec3& P, float wider, const Visit& f) const {
  if (!holds(boxes_[level][box].grown(wider), P)) return;
  const size_t first = box * kFan, below = level == 0 ? radius_.size() : boxes_[level - 1].size();
  for (size_t i = first; i < std::min(first + kFan, below); ++i)
    if (level == 0)
      f(static_cast<uint32_t>(i));
    else
      visit(level - 1, i, P, wider, f);
}

vec3 CausticPhotons::irradiance(const vec3& P, const vec3& N, int surface, float radius) const {
  vec3 E(0.0f);
  if (boxes_.empty()) return E;
  // The kernel has a variance of r^2 / 6 along each axis, and a square of edges 2 R one of R^2 / 3.
  const float own2 = 2 * radius * radius;
  visit(boxes_.size() - 1, 0, P, std::sqrt(own2), [&](uint32_t i) {
    const float r2 = radius_[i] * radius_[i] + own2, to2 = tree_.distance2(i, P, N, surface);
    if (!(to2 < r2)) return;
    const float* w = tree_.photons().at(i) + power_;
    E += vec3(w[0], w[1], w[2]) * (2 * (1 - to2 / r2) / (kPi * r2));
  });
  return E;
}

}  // namespace tomales
