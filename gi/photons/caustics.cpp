#include "gi/photons/caustics.h"

#include "reyes/base/check.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

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
  boxes_ = RunBoxes(radius_.size(), [&](size_t i) {
    const vec3& P = tree_.position(static_cast<uint32_t>(i));
    return Bound3{P - radius_[i], P + radius_[i]};
  });
}

vec3 CausticPhotons::irradiance(const vec3& P, const vec3& N, int surface, float radius) const {
  vec3 E(0.0f);
  // Along each axis the kernel has a variance of r^2 / 6, and a square with edges of 2 R has one of R^2 / 3.
  const float own2 = 2 * radius * radius;
  const float wider = std::sqrt(own2);
  boxes_.visit([&](const Bound3& box) { return holds(box.grown(wider), P); },
               [&](size_t at) {
                 const auto i = static_cast<uint32_t>(at);
                 const float r2 = radius_[i] * radius_[i] + own2, to2 = tree_.distance2(i, P, N, surface);
                 if (!(to2 < r2)) return;
                 const float* w = tree_.photons().at(i) + power_;
                 E += vec3(w[0], w[1], w[2]) * (2 * (1 - to2 / r2) / (kPi * r2));
               });
  return E;
}

}  // namespace tomales
