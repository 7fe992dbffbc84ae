// The buckets of a frame, and which of them a raster bound touches. Threads: immutable.
#pragma once
#include <algorithm>

#include "reyes/deep.h"

namespace tomales {

/// Columns c0 .. c1 and rows r0 .. r1 of buckets, both included.
struct BucketRange {
  int c0 = 0, c1 = -1, r0 = 0, r1 = -1;
  int columns() const { return c1 - c0 + 1; }
  int count() const { return empty() ? 0 : columns() * (r1 - r0 + 1); }
  bool empty() const { return c1 < c0 || r1 < r0; }
  BucketRange operator&(const BucketRange& o) const {
    return {std::max(c0, o.c0), std::min(c1, o.c1), std::max(r0, o.r0), std::min(r1, o.r1)};
  }
};

class BucketGrid {
 public:
  explicit BucketGrid(const DeepFrame& frame)
      : window_(frame.padded),
        width_(frame.bucketWidth),
        height_(frame.bucketHeight),
        columns_(frame.columns),
        rows_(frame.rows) {}

  const PixelRect& window() const { return window_; }
  BucketRange all() const { return {0, columns_ - 1, 0, rows_ - 1}; }
  BucketRange touched(const Bound2& b) const {
    const auto x0 = static_cast<float>(window_.x0), y0 = static_cast<float>(window_.y0);
    if (b.hi.x < x0 || b.hi.y < y0 || b.lo.x > static_cast<float>(window_.x1) ||
        b.lo.y > static_cast<float>(window_.y1))
      return {};
    const auto index = [](float at, int size, int count) {
      const float i = std::floor(at / static_cast<float>(size));
      return static_cast<int>(std::clamp(i, 0.0f, static_cast<float>(count - 1)));
    };
    return {index(b.lo.x - x0, width_, columns_), index(b.hi.x - x0, width_, columns_),
            index(b.lo.y - y0, height_, rows_), index(b.hi.y - y0, height_, rows_)};
  }
  BucketRange only(size_t bucket) const { return {column(bucket), column(bucket), row(bucket), row(bucket)}; }
  int column(size_t bucket) const { return static_cast<int>(bucket) % columns_; }
  int row(size_t bucket) const { return static_cast<int>(bucket) / columns_; }

 private:
  PixelRect window_;
  int width_, height_, columns_, rows_;
};

}  // namespace tomales
