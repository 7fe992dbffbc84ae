// The samples of one bucket, and the grids that compete for them. Private to the hider.
// A micropolygon is named by its number among all cells inserted: the grid's first number plus its cell
// index.
#pragma once
#include <cfloat>

#include "reyes/hide.h"

namespace tomales {

constexpr float kNothing = FLT_MAX;  ///< Depth key of a sample that nothing opaque covers.
constexpr uint32_t kNoCell = ~0U;

/// Grids in order of insertion.
class GridTable {
 public:
  struct Entry {
    uint32_t firstCell;
    std::shared_ptr<const RasterGrid> raster;
    std::vector<float> keyTimes;  ///< Fractions of the shutter; one for a still grid.
    const Grid& grid() const { return *raster->grid; }
  };

  const Entry& add(const std::shared_ptr<const RasterGrid>& raster, std::vector<float> keyTimes);
  const Entry& of(uint32_t cell) const;
  uint32_t cellCount() const { return cells_; }
  /// Decides between equal depths: by name, never by pointer or order of insertion.
  bool precedes(uint32_t a, uint32_t b) const;

 private:
  std::vector<Entry> entries_;
  uint32_t cells_ = 0;
};

/// Something transparent that covers a sample.
struct Layer {
  uint32_t pixel, cell, lane;
  float d;
};

struct SampleBuffer {
  SampleBuffer(const SamplePattern& pattern, const PixelRect& rect);

  PixelRect rect;
  int lanes;                      ///< Of a pixel, a multiple of kLanes.
  const float *x, *y, *time, *lensX, *lensY, *detail;  ///< Of all patterns.
  std::vector<size_t> patternAt;  ///< A pixel: where its samples begin in x, y, time and lens.
  AlignedVector<float>
      depth;  ///< A lane: key of the nearest opaque hit; -infinity in padding, which so never counts.
  AlignedVector<uint32_t> cell;  ///< A lane: that hit.
  AlignedVector<float> far;      ///< A pixel: the greatest depth of its lanes.
  std::vector<Layer> layers;
  std::vector<Layer> crossings;  ///< Everything of solids that covers a sample, however deep.

  size_t pixelIndex(int column, int row) const {
    return static_cast<size_t>((row - rect.y0) * (rect.x1 - rect.x0) + (column - rect.x0));
  }
  /// Pixels of the bucket that a raster bound touches.
  PixelRect touched(const vec2& lo, const vec2& hi) const {
    // Clamped while still float: a vertex near the eye plane may lie farther out than an int can tell.
    const auto floorWithin = [](float v, int first, int end) {
      const float offset = v - static_cast<float>(first), size = static_cast<float>(end - first);
      return first - 1 + static_cast<int>(std::clamp(offset, -1.0f, size) + 1);
    };
    return {std::max(floorWithin(lo.x, rect.x0, rect.x1), rect.x0),
            std::max(floorWithin(lo.y, rect.y0, rect.y1), rect.y0),
            std::min(floorWithin(hi.x, rect.x0, rect.x1) + 1, rect.x1),
            std::min(floorWithin(hi.y, rect.y0, rect.y1) + 1, rect.y1)};
  }
  /// Is every sample of the pixels nearer than depth key d?
  bool hides(const PixelRect& pixels, float d) const;
};

}  // namespace tomales
