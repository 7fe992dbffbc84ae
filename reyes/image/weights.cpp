#include "reyes/image/weights.h"

namespace tomales {
namespace {

static_assert(kLanes % (2 * PixelSums::kWide) == 0);

/// GCC 12 leaves the plain loops scalar.
using Wide = float __attribute__((vector_size(PixelSums::kWide * sizeof(float)), aligned(alignof(float)), may_alias));
inline Wide& wide(float* p) { return *reinterpret_cast<Wide*>(p); }
inline const Wide& wide(const float* p) { return *reinterpret_cast<const Wide*>(p); }

/// Adds up rows of weights, those of the samples in `mask`, in their order.
TOMALES_HOT void addRows(const float* rows, int stride, uint64_t mask, float* out) {
  for (int k = 0; k < stride; k += 2 * PixelSums::kWide) {
    Wide low{}, high{};
    for (uint64_t left = mask; left; left &= left - 1) {
      const float* row = rows + lowestBit(left) * stride + k;
      low += wide(row), high += wide(row + PixelSums::kWide);
    }
    wide(out + k) = low, wide(out + k + PixelSums::kWide) = high;
  }
}

/// to[i] += weights[i] * values for `count` pixels of `width` floats.
TOMALES_HOT void addScaled(float* to, const float* weights, int count, const float* values, int width) {
  for (int k = 0; k < width; k += PixelSums::kWide) {
    const Wide value = wide(values + k);
    for (int i = 0; i < count; ++i) wide(to + i * width + k) += weights[i] * value;
  }
}

}  // namespace

void WeightTable::sums(int pattern, uint64_t mask, uint16_t word, float* out) const { addRows(of(pattern, word), stride_, mask, out); }

PixelSums::PixelSums(const WeightTable& weights, const PixelRect& block, int floats)
    : weights_(weights), block_(block), width_((floats + kWide - 1) / kWide * kWide),
      sums_(static_cast<size_t>(width_) * static_cast<size_t>(block.width()) * static_cast<size_t>(block.height())) {}

void PixelSums::add(int x, int y, const float* weights, const float* values) {
  const int x0 = std::max(x - weights_.reachX, block_.x0), x1 = std::min(x + weights_.reachX + 1, block_.x1);
  const int y0 = std::max(y - weights_.reachY, block_.y0), y1 = std::min(y + weights_.reachY + 1, block_.y1);
  const int columns = 2 * weights_.reachX + 1;
  for (int row = y0; row < y1 && x0 < x1; ++row)
    addScaled(at(x0, row), weights + (row - y + weights_.reachY) * columns + x0 - x + weights_.reachX, x1 - x0, values, width_);
}

}  // namespace tomales
