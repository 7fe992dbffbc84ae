// Private to the hider: the samples of one bucket, and the grids that compete for them. A micropolygon is identified by
// its number among all cells inserted, which is the grid's first number plus the cell's index.
#pragma once
#include <cfloat>

#include "reyes/hide.h"
#include "reyes/hide/transparent_layers.h"

namespace tomales {

constexpr float kNothing = FLT_MAX;  ///< Depth key of a sample that nothing opaque covers.
constexpr uint32_t kNoCell = TransparentLayers::kNoCell;

/// Grids in the order of insertion.
class GridTable {
 public:
  struct Entry {
    uint32_t firstCell;
    std::shared_ptr<const RasterGrid> raster;  ///< Null once the grid has been freed.
    std::vector<float> keyTimes;               ///< Fractions of the shutter; empty for a still grid.
    const Grid& grid() const { return *raster->grid; }
  };

  const Entry& add(const std::shared_ptr<const RasterGrid>& raster, std::vector<float> keyTimes);
  const Entry& of(uint32_t cell) const { return entries_[entryOfPage_[cell / kPage]]; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// Returns a number that is greater than every cell's.
  uint32_t cellCount() const { return static_cast<uint32_t>(entryOfPage_.size()) * kPage; }
  /// Frees every grid that has none of these cells. Pre: sorted.
  void keepOnly(const std::vector<uint32_t>& cells);
  size_t held() const { return held_; }          ///< Number of grids that are not freed.
  bool anySmooth() const { return anySmooth_; }  ///< True if any grid is RasterGrid::smooth.
  /// Decides between cells of equal depth by their names, never by pointer or order of insertion.
  bool precedes(uint32_t a, uint32_t b) const;

 private:
  static constexpr uint32_t kPage = 16;  ///< The numbers of a grid begin at multiples of this.
  std::vector<Entry> entries_;
  std::vector<uint32_t> entryOfPage_;
  size_t held_ = 0;
  bool anySmooth_ = false;
};

/// A sample for which two objects compete whose depths differ by less than their error (z-fighting).
struct DepthConflict {
  uint32_t lane;
  int first, second;  ///< first < second
  float least;        ///< Depth key of the nearer one. If the sample's final key is smaller, both are hidden.
  bool operator==(const DepthConflict& o) const { return lane == o.lane && first == o.first && second == o.second; }
};

/// A pixel whose samples are to be tested against a micropolygon, one of kLanes.
struct PixelTest {
  uint32_t pixel;
  int cell;
};

/// Arrays have a lane for each sample. The lanes of a pixel are adjacent and padded to `lanes`; no cell ever takes a
/// padding lane.
struct SampleBuffer {
  SampleBuffer(const SamplePattern& pattern, const Camera& camera, const PixelRect& rect);

  PixelRect rect;
  int lanes;                        ///< Lanes of a pixel, a multiple of kLanes.
  vec2 origin;                      ///< Raster position from which the lattice counts here.
  UnsetVector<float> x, y;          ///< Raster position.
  UnsetVector<int32_t> xy;          ///< The same on the lattice if it fits: y in the upper half, x in the lower.
  UnsetVector<float> time;          ///< Fraction of the shutter. It and the lens are empty before addTimesAndLens().
  UnsetVector<float> lensX, lensY;  ///< Raster shift at a depth key of Camera::focusKey() + 1.
  /// Depth key of the nearest opaque hit; -infinity in padding, so that nothing is in front of it.
  AlignedVector<float> depth;
  AlignedVector<uint32_t> cell;   ///< Cell of that hit.
  std::vector<uint32_t> pixelOf;  ///< Pixel of each group of kLanes lanes.
  AlignedVector<float> far;       ///< Indexed by pixel: an upper bound of the depths of its lanes.
  std::vector<uint8_t> nearer;    ///< Indexed by pixel: 1 if depths may have changed since `far` was computed.
  TransparentLayers layers;
  TransparentLayers crossings;        ///< All surfaces of solids that cover a sample, however deep.
  std::vector<PixelTest> pixelTests;  ///< Memory for the rasterisers.
  /// Conflicts of opaque, still surfaces in focus; some may be hidden later.
  std::vector<DepthConflict> depthConflicts;

  /// Tells whether 16 bits hold the positions on the lattice.
  bool fitsLattice() const {
    return rect.width() <= 2 * kHalf_px && rect.height() <= 2 * kHalf_px && std::max(rect.x1, rect.y1) <= kMostExact_px;
  }
  /// Makes times and lens positions, for the first grid that moves or is out of focus.
  void addTimesAndLens();
  /// Returns a lane's number from 0 to 1 that DetailShare compares with.
  float detail(size_t lane) const {
    const size_t width = static_cast<size_t>(lanes);
    return pattern_.detail(patternAt_[lane / width])[lane % width];
  }
  /// Returns the layers that get the samples of a transparent grid or a solid.
  TransparentLayers& layersOf(const RasterGrid& raster) { return raster.inSolid ? crossings : layers; }
  /// Returns the number of samples of a pixel.
  int sampleCount() const { return pattern_.count(); }
  /// Returns TransparentLayer::word of a sample of a pixel.
  uint32_t wordOf(uint32_t pixel, uint32_t sample) const {
    return pixel * static_cast<uint32_t>(layers.wordsOfPixel()) + sample / 64;
  }
  /// Updates `far`.
  void settle(const PixelRect& pixels);

  size_t pixelIndex(int column, int row) const {
    return static_cast<size_t>((row - rect.y0) * (rect.x1 - rect.x0) + (column - rect.x0));
  }
  /// Returns the pixels of the bucket that a raster bound touches.
  PixelRect touched(const vec2& lo, const vec2& hi) const {
    // The value is clamped as a float: a vertex near the eye plane may lie farther out than an int can hold.
    const auto floorWithin = [](float v, int first, int end) {
      const float offset = v - static_cast<float>(first), size = static_cast<float>(end - first);
      return first - 1 + static_cast<int>(std::clamp(offset, -1.0f, size) + 1);
    };
    return {std::max(floorWithin(lo.x, rect.x0, rect.x1), rect.x0),
            std::max(floorWithin(lo.y, rect.y0, rect.y1), rect.y0),
            std::min(floorWithin(hi.x, rect.x0, rect.x1) + 1, rect.x1),
            std::min(floorWithin(hi.y, rect.y0, rect.y1) + 1, rect.y1)};
  }
  /// Returns all cells that some sample sees or, for solids, may see, sorted.
  std::vector<uint32_t> seen() const;
  /// Tells whether every sample of the pixels is nearer than depth key d.
  bool hides(const PixelRect& pixels, float d) const {
    for (int row = pixels.y0; row < pixels.y1; ++row)
      for (int column = pixels.x0; column < pixels.x1; ++column)
        if (!(far[pixelIndex(column, row)] < d)) return false;
    return true;
  }
  /// Tells whether every sample within a raster bound is nearer than depth key d. If the bound covers only a few
  /// pixels, samples are tested one by one, because a small bound mostly lies between them.
  bool hides(const Bound2& bound, float d) const;

 private:
  static constexpr int kFew_px = 4, kHalf_px = 32;
  static constexpr int kMostExact_px = 16384;  ///< Beyond it floats round positions, some of them to the next pixel.
  const SamplePattern& pattern_;
  const vec2 lens_;
  std::vector<int> patternAt_;  ///< Indexed by pixel.
};

}  // namespace tomales
