// The facts about a frame that a gather pass needs before its first phase.
#pragma once
#include <atomic>
#include <vector>

#include "reyes/deep.h"

namespace tomales {

struct FrameSurvey {
  std::vector<uint32_t> points;  ///< Number of points of each tile.
  Bound3 bound;                  ///< Bound of all points.
  /// Sum of the hashes of the pixels that see each group first; it does not depend on buckets.
  std::vector<uint64_t> seenOfGroup;
};

FrameSurvey surveyOf(const DeepFrame& layout, const TileReader& tiles, size_t groups,
                     const std::atomic<bool>* cancelled);

/// One bit for every point of a frame.
class PointBits {
 public:
  /// points[t]: number of points of tile t.
  explicit PointBits(const std::vector<uint32_t>& points) : first_(points.size() + 1) {
    for (size_t t = 0; t < points.size(); ++t)
      first_[t + 1] = first_[t] + (points[t] + 63) / 64;  // no two tiles share a word
    words_.resize(first_.back());
  }
  /// Sets a bit. Returns false if it was set before.
  bool set(size_t tile, size_t point) {
    uint64_t &word = words_[first_[tile] + point / 64], bit = uint64_t{1} << point % 64;
    return !(word & bit) && (word |= bit);
  }

 private:
  std::vector<size_t> first_;
  std::vector<uint64_t> words_;
};

}  // namespace tomales
