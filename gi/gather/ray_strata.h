// Private to gi: directions and times of the rays of one hemisphere.
#pragma once
#include "gi/gather.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {

/// Places of the rays in their cells: correlated multi-jitter (Kensler 2013). The rays of a ring have different heights
/// within their cells, and the rays of a sector different angles. So the projection of all rays to heights, or to
/// angles, is stratified as finely as there are rays. Plain jitter needs more rays for the same error
/// (docs/measured/indirect.md).
class CellJitter {
 public:
  CellJitter(const HemisphereCells& cells, uint32_t key)
      : key_(key),
        height_(permutation(cells.sectors, key ^ randomStream("height"))),
        angle_(permutation(cells.rings, key ^ randomStream("angle"))) {}

  vec2 operator()(int ring, int sector, uint32_t ray) const {
    const uint32_t name = hashCombine(key_, ray);
    return {within(height_, sector, name ^ randomStream("in height")),
            within(angle_, ring, name ^ randomStream("in angle"))};
  }

 private:
  static float within(const std::vector<int>& strata, int i, uint32_t name) {
    return (static_cast<float>(strata[static_cast<size_t>(i)]) + unitFloat(hash32(name))) /
           static_cast<float>(strata.size());
  }
  uint32_t key_;
  std::vector<int> height_, angle_;
};

/// Times of the rays: equal strata of the shutter in an order that is independent of the cells.
class ShutterStrata {
 public:
  ShutterStrata(const RayScene& scene, const GatherPoint& point, size_t count, uint32_t key)
      : fixed_(std::max(point.time, 0.0f)), key_(key) {
    if (point.time < 0 && scene.samplesTime(point.group))
      strata_ = permutation(static_cast<int>(count), key ^ randomStream("time"));
  }
  float operator()(size_t ray) const {
    if (strata_.empty()) return fixed_;
    const float inside = unitFloat(hashCombine(key_, static_cast<uint32_t>(ray), randomStream("time")));
    return std::min((static_cast<float>(strata_[ray]) + inside) / static_cast<float>(strata_.size()), 0x1.fffffep-1f);
  }

 private:
  float fixed_;
  uint32_t key_;
  std::vector<int> strata_;
};

}  // namespace tomales
