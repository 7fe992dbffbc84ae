// The hidden buckets of a frame between the passes that read them: in memory up to a budget, the others in a file.
// Threads: any, but one at a time for each bucket.
#pragma once
#include <atomic>
#include <optional>

#include "reyes/deep.h"

namespace tomales {

class TileStore {
 public:
  /// Loads a tile that is not in memory, or returns nothing if it does not exist.
  using Load = std::function<std::optional<DeepTile>(size_t tile)>;
  /// Puts a tile where `load` finds it.
  using Spill = std::function<void(size_t index, const DeepTile& tile)>;
  TileStore(size_t tiles, int64_t budget_bytes, Load load)
      : load_(std::move(load)), budget_bytes_(budget_bytes), kept_(tiles) {}

  /// Returns false if the tile does not fit; the caller then has to put it where `load` finds it.
  bool keep(size_t index, DeepTile& tile) {
    const auto bytes = static_cast<int64_t>(tile.bytes());
    if ((held_bytes_ += bytes) > budget_bytes_) {
      held_bytes_ -= bytes;
      return false;
    }
    kept_[index] = std::make_shared<DeepTile>(std::move(tile));
    return true;
  }

  int64_t held_bytes() const { return held_bytes_; }

  /// Lowers the budget and puts tiles that exceed it where `load` finds them. Do not call it while tiles are read.
  void shrinkTo(int64_t budget_bytes, const Spill& spill) {
    budget_bytes_ = budget_bytes;
    for (size_t i = 0; i < kept_.size() && held_bytes_ > budget_bytes_; ++i) {
      if (!kept_[i]) continue;
      spill(i, *kept_[i]);
      held_bytes_ -= static_cast<int64_t>(kept_[i]->bytes());
      kept_[i].reset();
    }
  }

  /// Returns a tile to look at; null if it is nowhere.
  std::shared_ptr<const DeepTile> read(size_t index) {
    if (kept_[index]) return kept_[index];
    std::optional<DeepTile> tile = load_(index);
    if (!tile) return nullptr;
    if (keep(index, *tile)) return kept_[index];
    return std::make_shared<const DeepTile>(std::move(*tile));
  }
  TileReader reader() {
    return [this](size_t index) { return read(index); };
  }

  /// Returns a tile and forgets it here.
  std::optional<DeepTile> take(size_t index) {
    if (!kept_[index]) return load_(index);
    DeepTile tile = std::move(*kept_[index]);
    kept_[index].reset();
    held_bytes_ -= static_cast<int64_t>(tile.bytes());
    return tile;
  }

 private:
  const Load load_;
  int64_t budget_bytes_;
  std::atomic<int64_t> held_bytes_{0};
  std::vector<std::shared_ptr<DeepTile>> kept_;
};

}  // namespace tomales
