// The samples of one bucket, and the grids that compete for them. Private to the hider.
// A micropolygon is named by its number among all cells inserted: the grid's first number plus its cell index.
#pragma once
#include <cfloat>

#include "reyes/hide.h"

namespace tomales {

constexpr float kNothing = FLT_MAX;   ///< Depth key of a sample that nothing opaque covers.
constexpr uint32_t kNoCell = ~0U;

/// Grids in order of insertion.
class GridTable {
 public:
  struct Entry {
    uint32_t firstCell;
    std::shared_ptr<const RasterGrid> raster;
    const Grid& grid() const { return *raster->grid; }
  };

  /// Returns the number of the grid's first cell.
  uint32_t add(const std::shared_ptr<const RasterGrid>& raster);
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
  uint32_t sample;  ///< pixel * lanes + lane
  uint32_t cell;
  float d;
};

struct SampleBuffer {
  SampleBuffer(const SamplePattern& pattern, const PixelRect& rect);

  PixelRect rect;
  const SamplePattern& pattern;
  int lanes;                      ///< Of a pixel, a multiple of kLanes.
  std::vector<int> patternOf;     ///< A pixel
  AlignedVector<float> depth;     ///< A lane: key of the nearest opaque hit; -infinity in padding, which so never counts.
  AlignedVector<uint32_t> cell;   ///< A lane: that hit.
  AlignedVector<float> far;       ///< A pixel: the greatest depth of its lanes.
  std::vector<Layer> layers;

  size_t pixelIndex(int x, int y) const {
    return static_cast<size_t>((y - rect.y0) * rect.width() + (x - rect.x0));
  }
  /// Pixels of the bucket that a raster bound touches.
  PixelRect touched(const vec2& lo, const vec2& hi) const;
  /// Is every sample of the pixels nearer than depth key d?
  bool hides(const PixelRect& pixels, float d) const;
};

}  // namespace tomales
