#include "reyes/image/weights.h"

#include <bit>

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
[[gnu::always_inline]] inline void addRows(const float* rows, size_t stride, uint64_t mask, float* out) {
  for (size_t k = 0; k < stride; k += 2 * kHalf) {
    Vector<kHalf> low{}, high{};
    for (uint64_t left = mask; left; left &= left - 1) {
      const float* row = rows + static_cast<size_t>(std::countr_zero(left)) * stride + k;
      low += vectorAt<kHalf>(row);
      high += vectorAt<kHalf>(row + kHalf);
    }
    vectorAt<kHalf>(out + k) = low;
    vectorAt<kHalf>(out + k + kHalf) = high;
  }
}

/// The pixels that a pixel's samples reach, by rows. places: indices of their weights in a row of the table.
struct Reached {
  float* to;
  ptrdiff_t rowStep;
  int rows, columns, width;
  int firstPlace, placesInRow, stride;
};

/// Adds to a block of adjacent pixels, kFloats of each from `to` on. A pixel's sum is complete before it is stored.
template <int kRows, int kColumns, int kFloats>
[[gnu::always_inline]] inline void addTo(float* to, const Reached& r, const SeenFloats& seen, const float* weight,
                                         const float* value) {
  Vector<kFloats> sum[size_t{kRows}][size_t{kColumns}];
  const auto forEach = [&](const auto& body) __attribute__((always_inline)) {
    for (int row = 0; row < kRows; ++row)
      for (int i = 0; i < kColumns; ++i) body(sum[row][i], row, i);
  };
  forEach([&](Vector<kFloats>& s, int row, int i) { s = vectorAt<kFloats>(to + row * r.rowStep + i * r.width); });
  for (size_t c = seen.list.size(); c > 0; --c, weight += r.stride, value += seen.step)
    forEach(
        [&](Vector<kFloats>& s, int row, int i) { s += weight[row * r.placesInRow + i] * vectorAt<kFloats>(value); });
  forEach([&](Vector<kFloats>& s, int row, int i) { vectorAt<kFloats>(to + row * r.rowStep + i * r.width) = s; });
}

/// Adds PixelSums::width() floats for each pixel, in the widest vectors for which there are registers.
template <int kRows, int kColumns>
[[gnu::always_inline]] inline void addAll(float* to, const Reached& r, const SeenFloats& seen, const float* weight) {
  int k = 0;
  for (; kRows == 1 && k + kHalf <= r.width; k += kHalf)
    addTo<kRows, kColumns, kHalf>(to + k, r, seen, weight, seen.values + k);
  for (; k < r.width; k += PixelSums::kWide)
    addTo<kRows, kColumns, PixelSums::kWide>(to + k, r, seen, weight, seen.values + k);
}

/// `rows`: the weights of the pattern's samples. `weights` is set to the weights of the contributions.
TOMALES_HOT void addAround(const Reached& r, const SeenFloats& seen, const float* rows, float* weights) {
  const auto stride = static_cast<size_t>(r.stride);
  float* sums = weights;
  for (const Contribution& c : seen.list) {
    addRows(rows + size_t{64} * c.word * stride, stride, c.samples, sums);
    sums += stride;
  }
  weights += r.firstPlace;
  if (r.rows == 3 && r.columns == 3) return addAll<3, 3>(r.to, r, seen, weights);  // the default filter
  for (int row = 0; row < r.rows; ++row) {
    float* to = r.to + row * r.rowStep;
    const float* weight = weights + row * r.placesInRow;
    int i = 0;
    for (; i + 3 <= r.columns; i += 3) addAll<1, 3>(to + i * r.width, r, seen, weight + i);
    for (; i < r.columns; ++i) addAll<1, 1>(to + i * r.width, r, seen, weight + i);
  }
}

}  // namespace

PixelSums::PixelSums(const WeightTable& weights, const PixelRect& block, int floats)
    : weights_(weights),
      block_(block),
      width_((floats + kWide - 1) / kWide * kWide),
      sums_(static_cast<size_t>(width_) * static_cast<size_t>(block.width()) * static_cast<size_t>(block.height())) {}

void PixelSums::add(int x, int y, int pattern, const SeenFloats& seen) {
  const size_t needed = seen.list.size() * static_cast<size_t>(weights_.places());
  if (weightsOfSeen_.size() < needed) weightsOfSeen_.resize(needed);
  const int x0 = std::max(x - weights_.reachX, block_.x0), x1 = std::min(x + weights_.reachX + 1, block_.x1);
  const int y0 = std::max(y - weights_.reachY, block_.y0), y1 = std::min(y + weights_.reachY + 1, block_.y1);
  const int columns = 2 * weights_.reachX + 1;
  addAround({sums_.data() + indexOf(x0, y0) * width_, static_cast<ptrdiff_t>(block_.width()) * width_, y1 - y0, x1 - x0,
             width_, (y0 - y + weights_.reachY) * columns + x0 - x + weights_.reachX, columns, weights_.places()},
            seen, weights_.of(pattern, 0), weightsOfSeen_.data());
}

}  // namespace tomales
