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

/// `count` values of `width` floats, and a weight of each, `stride` floats apart.
struct Weighted {
  const float *weights, *values;
  int count, stride, width;
};

/// For some pixels that follow each other, and places that do. A pixel adds up all that comes before it is stored.
TOMALES_HOT void addScaled(float* to, int pixels, const Weighted& w) {
  for (int i = 0; i < pixels; ++i)
    for (int k = 0; k < w.width; k += PixelSums::kWide, to += PixelSums::kWide) {
      const float *weight = w.weights + i, *value = w.values + k;
      Wide sum = wide(to);
      for (int c = w.count; c > 0; --c, weight += w.stride, value += w.width) sum += *weight * wide(value);
      wide(to) = sum;
    }
}

}  // namespace

void WeightTable::sums(int pattern, uint64_t mask, uint16_t word, float* out) const { addRows(of(pattern, word), stride_, mask, out); }

PixelSums::PixelSums(const WeightTable& weights, const PixelRect& block, int floats)
    : weights_(weights), block_(block), width_((floats + kWide - 1) / kWide * kWide),
      sums_(static_cast<size_t>(width_) * static_cast<size_t>(block.width()) * static_cast<size_t>(block.height())) {}

void PixelSums::add(int x, int y, int count, const float* weights, const float* values) {
  const int x0 = std::max(x - weights_.reachX, block_.x0), x1 = std::min(x + weights_.reachX + 1, block_.x1);
  const int y0 = std::max(y - weights_.reachY, block_.y0), y1 = std::min(y + weights_.reachY + 1, block_.y1);
  const int columns = 2 * weights_.reachX + 1;
  for (int row = y0; row < y1; ++row)
    addScaled(sums_.data() + indexOf(x0, row) * width_, x1 - x0,
              {weights + (row - y + weights_.reachY) * columns + x0 - x + weights_.reachX, values, count, weights_.places(), width_});
}

}  // namespace tomales
