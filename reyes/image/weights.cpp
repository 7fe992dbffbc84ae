#include "reyes/image/weights.h"

namespace tomales {
namespace {

/// A vector type, because GCC 12 does not vectorise the plain loops.
template <int kFloats>
using Vector __attribute__((vector_size(kFloats * sizeof(float)), aligned(alignof(float)), may_alias)) = float;
template <int kFloats>
[[gnu::always_inline]] inline Vector<kFloats>& vectorAt(float* p) {
  return *reinterpret_cast<Vector<kFloats>*>(p);
}
template <int kFloats>
[[gnu::always_inline]] inline const Vector<kFloats>& vectorAt(const float* p) {
  return *reinterpret_cast<const Vector<kFloats>*>(p);
}

constexpr int kHalf = 8;
static_assert(kLanes % (2 * kHalf) == 0);

/// Adds up the rows of weights of the samples in `mask`, in their order.
TOMALES_HOT void addRows(const float* rows, int stride, uint64_t mask, float* out) {
  for (int k = 0; k < stride; k += 2 * kHalf) {
    Vector<kHalf> low{}, high{};
    for (uint64_t left = mask; left; left &= left - 1) {
      const float* row = rows + lowestBit(left) * stride + k;
      low += vectorAt<kHalf>(row);
      high += vectorAt<kHalf>(row + kHalf);
    }
    vectorAt<kHalf>(out + k) = low;
    vectorAt<kHalf>(out + k + kHalf) = high;
  }
}

/// Pixels that a pixel's samples reach, by rows. places: indices of their weights in a row of the table.
struct Reached {
  float* to;
  ptrdiff_t rowStep;
  int rows, columns, width;
  int firstPlace, placesInRow, stride;
};

/// Adds to kPixels adjacent pixels, kFloats of each from `to` on. A pixel's sum is complete before it is stored.
template <int kPixels, int kFloats>
[[gnu::always_inline]] inline void addTo(float* to, int width, const Weighted& seen, int stride, const float* weight,
                                         const float* value) {
  Vector<kFloats> sum[size_t{kPixels}];
  for (int i = 0; i < kPixels; ++i) sum[i] = vectorAt<kFloats>(to + i * width);
  for (int c = seen.count; c > 0; --c, weight += stride, value += seen.step)
    for (int i = 0; i < kPixels; ++i) sum[i] += weight[i] * vectorAt<kFloats>(value);
  for (int i = 0; i < kPixels; ++i) vectorAt<kFloats>(to + i * width) = sum[i];
}

/// Adds PixelSums::width() floats for each pixel, in the widest vectors.
template <int kPixels>
[[gnu::always_inline]] inline void addAll(float* to, int width, const Weighted& seen, int stride, const float* weight) {
  int k = 0;
  for (; k + kHalf <= width; k += kHalf) addTo<kPixels, kHalf>(to + k, width, seen, stride, weight, seen.values + k);
  for (; k < width; k += PixelSums::kWide)
    addTo<kPixels, PixelSums::kWide>(to + k, width, seen, stride, weight, seen.values + k);
}

TOMALES_HOT void addAround(const Reached& r, const Weighted& seen) {
  for (int row = 0; row < r.rows; ++row) {
    float* to = r.to + row * r.rowStep;
    const float* weight = seen.weights + r.firstPlace + row * r.placesInRow;
    int i = 0;
    for (; i + 3 <= r.columns; i += 3) addAll<3>(to + i * r.width, r.width, seen, r.stride, weight + i);
    for (; i < r.columns; ++i) addAll<1>(to + i * r.width, r.width, seen, r.stride, weight + i);
  }
}

}  // namespace

void WeightTable::sums(int pattern, uint64_t mask, uint16_t word, float* out) const {
  addRows(of(pattern, word), stride_, mask, out);
}

PixelSums::PixelSums(const WeightTable& weights, const PixelRect& block, int floats)
    : weights_(weights),
      block_(block),
      width_((floats + kWide - 1) / kWide * kWide),
      sums_(static_cast<size_t>(width_) * static_cast<size_t>(block.width()) * static_cast<size_t>(block.height())) {}

void PixelSums::add(int x, int y, const Weighted& seen) {
  const int x0 = std::max(x - weights_.reachX, block_.x0), x1 = std::min(x + weights_.reachX + 1, block_.x1);
  const int y0 = std::max(y - weights_.reachY, block_.y0), y1 = std::min(y + weights_.reachY + 1, block_.y1);
  const int columns = 2 * weights_.reachX + 1;
  addAround({sums_.data() + indexOf(x0, y0) * width_, static_cast<ptrdiff_t>(block_.width()) * width_, y1 - y0, x1 - x0,
             width_, (y0 - y + weights_.reachY) * columns + x0 - x + weights_.reachX, columns, weights_.places()},
            seen);
}

}  // namespace tomales
