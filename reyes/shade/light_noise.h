// How uncertain the samples of lights with an extent leave what the camera sees, counted while they are summed up
// anyway.
#pragma once
#include <atomic>
#include <deque>

#include "reyes/shade.h"

namespace tomales {

class Batch;
struct BoundScene;

/// Threads: any; counts are whole numbers, so that the order leaves no trace.
class LightNoise {
 public:
  /// `lights`: how many the scene has.
  explicit LightNoise(size_t lights) : uncertain_(lights) {}
  /// What a surface shader has asked of its lights.
  void add(Batch& batch);
  /// Reports the light that leaves most points uncertain, if those are most.
  void warn(const BoundScene& scene) const;

 private:
  std::atomic<int64_t> lit_{0};                 ///< Points that some light comes to.
  std::deque<std::atomic<int64_t>> uncertain_;  ///< Of them, by this light.
};

}  // namespace tomales
