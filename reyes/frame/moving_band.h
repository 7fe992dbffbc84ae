// Private to reyes/frame: the part of the frame that is in memory while its picture is written.
#pragma once
#include <algorithm>
#include <atomic>
#include <vector>

#include "reyes/frame.h"

namespace tomales {

/// Keeps in memory the tiles that some rows of pixels need, and fills further tiles as the rows move down.
class MovingBand {
 public:
  MovingBand(DeepFrame& frame, FrameFilter& filter, const TileFill& fill, const Options& options)
      : frame_(frame),
        filter_(filter),
        fill_(fill),
        reach_(static_cast<int>(filterReach(options).y)),
        needed_(tilesOf(frame, options)) {
    std::sort(needed_.begin(), needed_.end());
    frame.hold(0, 0);
  }

  /// Returns the share of the tiles of the whole picture that have been filled.
  float finished() const {
    return needed_.empty() ? 1.0f : static_cast<float>(finished_) / static_cast<float>(needed_.size());
  }

  void moveTo(int y0, int y1) {
    const int first = frame_.rowOf(std::max(y0 - reach_, frame_.padded.y0));
    const int last = frame_.rowOf(std::min(y1 + reach_, frame_.padded.y1) - 1) + 1;
    frame_.hold(first, last);
    const auto from = needed_.begin() + static_cast<std::ptrdiff_t>(filled_);
    const auto to = std::lower_bound(from, needed_.end(), static_cast<uint32_t>(last * frame_.columns));
    filled_ = static_cast<size_t>(to - needed_.begin());
    // Tiles are filled column by column: threads that begin far apart in the list should begin far apart in the picture
    // (FrameHider::hide).
    const auto columns = static_cast<uint32_t>(frame_.columns);
    std::stable_sort(from, to, [columns](uint32_t a, uint32_t b) { return a % columns < b % columns; });
    fill_({from, to}, [this](size_t index, DeepTile&& tile) {
      ++finished_;
      // resolves it now, while it is in the cache
      filter_.resolve(index, tile);
      if (!filter_.needsTiles()) return;
      tile.forgetPoints();
      frame_.tile(index) = std::move(tile);
    });
  }

 private:
  DeepFrame& frame_;
  FrameFilter& filter_;
  const TileFill& fill_;
  const int reach_;
  std::vector<uint32_t> needed_;
  size_t filled_ = 0;
  std::atomic<size_t> finished_{0};
};

}  // namespace tomales
