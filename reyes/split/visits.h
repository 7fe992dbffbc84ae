// Private to splitting: the number of pieces that splitting a patch may visit, so that it ends. Pure; lengths are in
// pixels of the raster.
#pragma once
#include "reyes/split.h"

namespace tomales {

class Visits {
 public:
  /// `window`: the raster pixels that have samples. A grid holds gridSize cells of edge edge_px.
  Visits(const PixelRect& window, int gridSize, float edge_px)
      : window_(window), gridSize_(gridSize), edge_px_(edge_px) {}

  /// Returns the budget of one of an object's `patches`.
  int64_t ofPatch(uint32_t patches) const;
  /// Returns the cost of a blurred piece beyond its visit, of an object with this many key times.
  int64_t ofBlur(const Bound2& raster, size_t keyTimes) const;
  /// Returns the visits that a coarse piece is expected to take.
  double expected(const SubPatch& coarse) const;

  int64_t grids(int nu, int nv) const { return static_cast<int64_t>(nu) * nv / gridSize_; }
  /// Tells whether much of the bound is in the window. If not, halving soon culls most of it, and the number of visits
  /// depends little on its grids: a strip that runs past the eye is thousands of windows wide.
  bool isLargelySeen(const Bound2& raster) const;

 private:
  /// Returns the width and height of the part of a bound inside the window.
  glm::dvec2 sizeInWindow(const Bound2& raster) const;
  double windowArea() const { return static_cast<double>(window_.width()) * window_.height(); }

  const PixelRect window_;
  const int gridSize_;
  const float edge_px_;
};

}  // namespace tomales
