// Estimates the noise that samples of lights with an extent leave in the picture, from sums that shading makes anyway.
#pragma once
#include <atomic>
#include <deque>

#include "reyes/shade.h"

namespace tomales {

class Batch;
struct BoundScene;

/// Threads: any. Counts are whole numbers, so the order of calls does not matter.
class LightNoise {
 public:
  /// `lights` is the number of lights of the scene.
  explicit LightNoise(size_t lights) : uncertain_(lights) {}
  /// Counts the light samples that a surface shader has asked for.
  void add(Batch& batch);
  /// Reports the light that leaves the largest number of points uncertain, if that is most of the points.
  void warn(const BoundScene& scene) const;

 private:
  std::atomic<int64_t> lit_{0};                 ///< The number of points that some light reaches.
  std::deque<std::atomic<int64_t>> uncertain_;  ///< Number of those points that each light leaves uncertain.
};

}  // namespace tomales
