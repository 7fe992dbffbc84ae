// Private to reyes/image: filter weights of all samples that can reach a pixel.
#pragma once
#include "reyes/image.h"
#include "reyes/image/composite.h"

namespace tomales {

/// Filter weights of every sample of a pixel at (dx, dy) from the pixel that is being filtered.
class WeightTable {
 public:
  WeightTable(const PixelFilter& filter, const SampleOffsets& samples)
      : reachX(filter.reachX()), reachY(filter.reachY()), count_(static_cast<size_t>(samples.count)) {
    for (const std::vector<vec2>& offsets : samples.byPattern)
      for (int dy = -reachY; dy <= reachY; ++dy)
        for (int dx = -reachX; dx <= reachX; ++dx) {
          float sum = 0;
          for (const vec2& o : offsets) {
            weights_.push_back(filter(static_cast<float>(dx) + o.x - 0.5f, static_cast<float>(dy) + o.y - 0.5f));
            sum += weights_.back();
          }
          sums_.push_back(sum);
        }
  }

  const int reachX, reachY;
  size_t cell(int pattern, int dx, int dy) const {
    const int columns = 2 * reachX + 1, rows = 2 * reachY + 1;
    return static_cast<size_t>((pattern * rows + dy + reachY) * columns + dx + reachX);
  }
  float sum(size_t cell) const { return sums_[cell]; }
  float sum(size_t cell, uint64_t mask, uint16_t word) const {
    const float* w = weights_.data() + cell * count_ + static_cast<size_t>(word) * 64;
    float sum = 0;
    for (; mask; mask &= mask - 1) sum += w[lowestBit(mask)];
    return sum;
  }

 private:
  size_t count_;
  std::vector<float> weights_, sums_;
};

/// The tile of a pixel, or null where an interrupted frame has none.
inline const DeepTile* finishedTile(const DeepFrame& frame, int x, int y) {
  const DeepTile& tile = frame.tileAt(x, y);
  return tile.pixels.empty() || tile.shaded.size() < tile.batches.size() ? nullptr : &tile;
}

}  // namespace tomales
