// Private to gi: the caches that the shade groups of one frame fill and use, and which of them hold its records
// already. Lengths: current space.
#pragma once
#include "gi/frame/state.h"
#include "reyes/base/stop.h"

namespace tomales {

class FrameCaches {
 public:
  explicit FrameCaches(GiState& state) : state_(state) {}

  /// Adds the caches that are missing. Groups whose lights and shaders have equal keys share one. Returns false if
  /// there is nothing to gather: with maxerror 0 no record could be reused.
  bool prepare(const DeepFrame& layout, const TileReader&, StopToken stop);

  /// Indices in GiState::caches, for each group.
  const std::vector<std::vector<size_t>>& ofGroups() const { return ofGroups_; }
  /// Tells whether the cache has not been gathered for this very frame.
  bool isNew(size_t cache) const { return std::ranges::count(state_.caches[cache].frames, frames_[cache]) == 0; }
  /// Notes that all caches have been gathered for this frame.
  void rememberFrame();

 private:
  bool forgetKnown();

  GiState& state_;
  std::vector<std::vector<size_t>> ofGroups_;
  std::vector<uint64_t> frames_;  ///< Checksum of this frame's pixels, for each cache.
};

}  // namespace tomales
