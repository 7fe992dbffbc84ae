#include "reyes/app/relight/picture_parts.h"

namespace tomales {
namespace {

constexpr int kBucketsAcross = 4;  ///< Buckets along an edge of a part.

}  // namespace

PictureParts::PictureParts(const DeepFrame& frame, const PixelRect& window)
    : window_(window),
      bucketColumns_(static_cast<size_t>(frame.columns)),
      grid_((frame.columns + kBucketsAcross - 1) / kBucketsAcross, (frame.rows + kBucketsAcross - 1) / kBucketsAcross) {
  const int across = kBucketsAcross * frame.bucketWidth, down = kBucketsAcross * frame.bucketHeight;
  for (int row = 0; row < grid_.y; ++row)
    for (int column = 0; column < grid_.x; ++column) {
      const int x = frame.padded.x0 + column * across, y = frame.padded.y0 + row * down;
      parts_.push_back({std::clamp(x, window.x0, window.x1), std::clamp(y, window.y0, window.y1),
                        std::clamp(x + across, window.x0, window.x1), std::clamp(y + down, window.y0, window.y1)});
    }
}

size_t PictureParts::at(int column, int row) const {
  return static_cast<size_t>(std::clamp(row, 0, grid_.y - 1) * grid_.x + std::clamp(column, 0, grid_.x - 1));
}

size_t PictureParts::ofBucket(size_t bucket) const {
  return at(static_cast<int>(bucket % bucketColumns_) / kBucketsAcross,
            static_cast<int>(bucket / bucketColumns_) / kBucketsAcross);
}

std::array<size_t, 4> PictureParts::needing(size_t bucket) const {
  const int x = static_cast<int>(bucket % bucketColumns_), y = static_cast<int>(bucket / bucketColumns_);
  const int left = (x - 1) / kBucketsAcross, right = (x + 1) / kBucketsAcross, above = (y - 1) / kBucketsAcross,
            below = (y + 1) / kBucketsAcross;
  return {at(left, above), at(right, above), at(left, below), at(right, below)};
}

}  // namespace tomales
