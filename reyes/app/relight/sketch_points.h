// Points of a shot in the middle of squares of 16 x 16 pixels: shading them shows an edit at once, before the picture
// is shaded. Rays that they take are traced once, and again where an edit has them go another way.
#pragma once
#include <mutex>

#include "reyes/app/frame/shot.h"
#include "reyes/app/relight/layers.h"
#include "reyes/app/watch/sketch.h"

namespace tomales {

class SketchPoints {
 public:
  /// The points are in as many tiles as are given here.
  SketchPoints(const PixelRect& window, size_t tiles) : window_(window), reduced_(tiles) {}

  /// Takes the points of a bucket into one of the tiles, unless the bucket has been taken. Threads: any.
  void add(size_t bucket, const DeepTile& tile, size_t to);
  /// Forgets what rays have met: the next call of shade() traces them.
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
