// Points of a shot in the middle of squares of 16 x 16 pixels: shading them shows an edit at once, before the picture
// is shaded. Their rays are traced once, and again where an edit changes their way.
#pragma once
#include <mutex>

#include "reyes/app/frame/shot.h"
#include "reyes/app/relight/layers.h"
#include "reyes/app/watch/sketch.h"

namespace tomales {

class SketchPoints {
 public:
  /// `tiles`: number of tiles that the points are divided among.
  SketchPoints(const PixelRect& window, size_t tiles) : window_(window), reduced_(tiles) {}

  /// Adds the points of a bucket to the tile `to`, unless the bucket has been added already. Threads: any.
  void add(size_t bucket, const DeepTile& tile, size_t to);
  /// Forgets what rays have met, so that the next call of shade() traces them.
  void forgetRays();
  /// Returns the colours of the squares by rows, black where nothing is seen.
  std::vector<vec3> shade(ShotJob& job);

 private:
  struct Reduced {
    DeepTile tile{};
    std::vector<Corner> corners{};
  };
  const PixelRect window_;
  std::mutex mutex_;  ///< It guards what add() changes.
  std::set<size_t> taken_;
  std::vector<Reduced> reduced_;
};

}  // namespace tomales
