// Private to gi: what a gather pass asks of a tile, phase by phase. It keeps only what makes a GatherPoint. That takes
// a fifth of the tile's memory, and the tile need not stay in memory. Space: current.
#pragma once
#include <atomic>

#include "gi/frame/gather_places.h"

namespace tomales {

/// Further points of a pixel follow its nearest one in these phases, in the order of a hash.
constexpr int kLastPhases = 8;
constexpr int kGatherPhases = kLatticePhases + kLastPhases;

class GatherTile {
 public:
  /// gathers: for each group, whether anything is gathered at its points.
  GatherTile(const GiState&, const DeepTile&, const std::vector<uint8_t>& gathers);

  /// Calls f(point, x, y) for each point of a phase and the pixel that sees it, in the order of pixels. In the lattice
  /// phases these are the nearest points of pixels, and later the further points of pixels, each once.
  template <class F>
  void forPoints(const Camera& camera, int phase, const F& f) const {
    const auto p = static_cast<size_t>(phase);
    for (uint32_t i = end_[p]; i < end_[p + 1]; ++i) {
      const auto pixel = static_cast<int>(asked_[i].pixel);
      f(at(camera, asked_[i].place), rect_.x0 + pixel % rect_.width(), rect_.y0 + pixel / rect_.width());
    }
  }
  size_t bytes() const;

 private:
  struct Place {
    int group;
    uint32_t key;
    vec3 position, normal;
    float edgeLength;
  };
  struct Movement {
    vec3 drift;
    float time;
  };
  struct Asked {
    uint32_t place, pixel;
  };

  GatherPoint at(const Camera&, uint32_t place) const;
  void keep(const GatherPoint&);

  PixelRect rect_;
  std::vector<Place> places_;
  std::vector<Movement> movements_;  ///< Indexed by place; empty if nothing moves by itself.
  std::vector<Asked> asked_;         ///< Sorted by phase.
  std::vector<uint32_t> end_;        ///< End of each phase in asked_, after a 0.
};

/// The tiles of a frame for a gather pass: in memory up to a limit, the others made anew whenever they are read.
/// Threads: any, but one at a time for each tile.
class GatherTiles {
 public:
  GatherTiles(const GiState& state, const TileReader& tiles, size_t count, std::vector<uint8_t> gathers)
      : state_(state), tiles_(tiles), gathers_(std::move(gathers)), kept_(count) {}
  /// Returns null for a tile that has not been hidden.
  std::shared_ptr<const GatherTile> read(size_t index);

 private:
  const GiState& state_;
  const TileReader& tiles_;
  const std::vector<uint8_t> gathers_;
  std::vector<std::shared_ptr<const GatherTile>> kept_;
  std::atomic<size_t> kept_bytes_{0};
};

}  // namespace tomales
