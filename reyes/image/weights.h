// Private to reyes/image: filter weights of all samples that can reach a pixel.
#pragma once
#include <span>

#include "reyes/image.h"
#include "reyes/image/composite.h"

namespace tomales {

/// The weights of the samples of a pixel for the pixels around it that they reach.
class WeightTable {
 public:
  WeightTable(const PixelFilter& filter, const SampleOffsets& samples)
      : reachX(filter.reachX()),
        reachY(filter.reachY()),
        cells_((2 * reachX + 1) * (2 * reachY + 1)),
        stride_(padded(cells_)),
        count_(samples.count) {
    const size_t perPattern = static_cast<size_t>(count_ * stride_);
    weights_.resize(samples.byPattern.size() * perPattern);
    sums_.resize(samples.byPattern.size() * static_cast<size_t>(stride_));
    for (size_t p = 0; p < samples.byPattern.size(); ++p)
      for (int dy = -reachY; dy <= reachY; ++dy)
        for (int dx = -reachX; dx <= reachX; ++dx) {
          const auto [pattern, place] = cell(static_cast<int>(p), dx, dy);
          float sum = 0;
          for (size_t s = 0; s < samples.byPattern[p].size(); ++s) {
            const vec2& o = samples.byPattern[p][s];
            const float w = filter(static_cast<float>(dx) + o.x - 0.5f, static_cast<float>(dy) + o.y - 0.5f);
            weights_[p * perPattern + s * static_cast<size_t>(stride_) + static_cast<size_t>(place)] = w;
            sum += w;
          }
          sums_[p * static_cast<size_t>(stride_) + static_cast<size_t>(place)] = sum;
        }
  }

  /// A sample pattern, relative to one of the pixels that it reaches.
  struct Cell {
    int pattern, place;
  };
  const int reachX, reachY;
  /// (dx, dy) leads from the pixel that is filtered to the pixel with the pattern.
  Cell cell(int pattern, int dx, int dy) const { return {pattern, (reachY - dy) * (2 * reachX + 1) + reachX - dx}; }
  float sum(const Cell& cell) const { return sums(cell.pattern)[cell.place]; }
  float sum(const Cell& cell, uint64_t mask, uint16_t word) const {
    const float* w = of(cell.pattern, word) + cell.place;
    float sum = 0;
    for (; mask; mask &= mask - 1) sum += w[lowestBit(mask) * stride_];
    return sum;
  }

  /// Returns the sums of all cells of a pattern, by rows, padded: places(), then zeros.
  int places() const { return stride_; }
  const float* sums(int pattern) const { return sums_.data() + static_cast<ptrdiff_t>(pattern) * stride_; }
  /// Returns the weights of the samples of a pattern from a word of 64 on: places() for each sample.
  const float* of(int pattern, uint16_t word) const {
    return weights_.data() + (static_cast<ptrdiff_t>(pattern) * count_ + ptrdiff_t{64} * word) * stride_;
  }

 private:
  int cells_, stride_, count_;
  AlignedVector<float> weights_, sums_;
};

/// The contributions of a pixel, in order, with a run of floats for each, `step` apart.
struct SeenFloats {
  std::span<const Contribution> list;
  const float* values;
  size_t step;
};

/// Weighted sums of floats for the pixels of a block. Pixels in and around the block add their samples to them.
class PixelSums {
 public:
  static constexpr int kWide = 4;  ///< Floats of a pixel are padded to a multiple of this.
  static_assert(kWide <= ResolvedTile::kMargin);
  PixelSums(const WeightTable& weights, const PixelRect& block, int floats);
  int width() const { return width_; }
  /// Adds all contributions of pixel (x, y), whose samples have this pattern. Each has width() floats, of which those
  /// beyond `floats` of the constructor may have any value.
  void add(int x, int y, int pattern, const SeenFloats& seen);
  const float* of(int x, int y) const { return sums_.data() + indexOf(x, y) * width_; }

 private:
  ptrdiff_t indexOf(int x, int y) const {
    return static_cast<ptrdiff_t>(y - block_.y0) * block_.width() + x - block_.x0;
  }
  const WeightTable& weights_;
  const PixelRect block_;
  const int width_;
  AlignedVector<float> sums_, weightsOfSeen_;
};

/// Calls body(cell, pixel) for every pixel of `rect` whose samples reach pixel (x, y).
template <class Body>
void forNeighbours(const PixelRect& rect, const WeightTable& weights, const SampleOffsets& samples, int x, int y,
                   const Body& body) {
  for (int sy = std::max(y - weights.reachY, rect.y0); sy < std::min(y + weights.reachY + 1, rect.y1); ++sy)
    for (int sx = std::max(x - weights.reachX, rect.x0); sx < std::min(x + weights.reachX + 1, rect.x1); ++sx)
      body(weights.cell(samples.patternOf(sx, sy), sx - x, sy - y), ivec2(sx, sy));
}

/// Returns the tile of a pixel, or null where an interrupted frame has none.
inline const DeepTile* finishedTile(const DeepFrame& frame, int x, int y) {
  const DeepTile& tile = frame.tileAt(x, y);
  return tile.pixels.empty() || tile.shaded.size() < tile.batches.size() ? nullptr : &tile;
}

}  // namespace tomales
