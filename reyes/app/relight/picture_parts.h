// The parts in which a picture is shaded: squares of buckets. Threads: any.
#pragma once
#include <array>

#include "reyes/deep.h"

namespace tomales {

class PictureParts {
 public:
  /// window: the pixels of the picture.
  PictureParts(const DeepFrame& frame, const PixelRect& window);

  const PixelRect& window() const { return window_; }
  size_t count() const { return parts_.size(); }
  /// Returns the pixels of a part. It has none if it is made of the filter's margin alone.
  const PixelRect& operator[](size_t part) const { return parts_[part]; }
  size_t ofBucket(size_t bucket) const;
  /// Returns the parts that need a bucket, since each reaches one bucket beyond its border. Some may come more than
  /// once.
  std::array<size_t, 4> needing(size_t bucket) const;

 private:
  size_t at(int column, int row) const;

  PixelRect window_;
  size_t bucketColumns_;
  ivec2 grid_;  ///< Columns and rows of parts.
  std::vector<PixelRect> parts_;
};

}  // namespace tomales
