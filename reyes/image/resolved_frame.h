// What the samples of a frame's pixels see, tile by tile, for as long as rows of pixels need it. Private to
// reyes/image.
#pragma once
#include <memory>
#include <mutex>
#include <span>

#include "reyes/image.h"
#include "reyes/image/composite.h"

namespace tomales {

/// Threads: tiles may be resolved at the same time, and looked at when they are.
class ResolvedFrame {
 public:
  ResolvedFrame(const DeepFrame& frame, const FrameOutput& output, const Options& options);

  int width() const { return width_; }  ///< Floats of a contribution.
  const std::vector<ExtraFloat>& extras() const { return extras_; }

  void resolve(size_t index, const DeepTile& tile);
  /// Those tiles that rows [y0, y1) touch and that nobody has brought, from the frame.
  void resolveRows(int y0, int y1);
  /// Those that lie above a row.
  void forgetAbove(int y);
  /// Are all tiles from that of row y on still there?
  bool reaches(int y) const { return firstTileOf(y) >= forgotten_; }
  /// Of all tiles that have been resolved; none where so few pixels have light that most are edges.
  PixelNoise noise() const;

  /// What the samples of a pixel see.
  struct Seen {
    std::span<const Contribution> list;
    const float* values;  ///< width() each; ResolvedTile::kMargin more may be read.
  };
  Seen seenAt(int x, int y) const { return runFrom(x, y).at(0, width_); }
  /// Calls visit(x, seen) for the pixels [x0, x1) of a row.
  template <class Visit>
  void forRow(int x0, int x1, int y, const Visit& visit) const {
    for (int x = x0; x < x1;) {
      const TileRun run = runFrom(x, y);
      for (size_t i = 0; x < std::min(run.end, x1); ++x, ++i) visit(x, run.at(i, width_));
    }
  }

 private:
  /// Pixels of one row from (x, y) on that lie in one tile.
  struct TileRun {
    const ResolvedTile* tile;  ///< Null: they see nothing.
    size_t pixel;              ///< Of the tile, the first of them.
    int end;                   ///< The x behind them.

    Seen at(size_t i, int width) const {
      if (!tile) return {};
      const size_t begin = tile->first[pixel + i], last = tile->first[pixel + i + 1];
      return {{tile->contributions.data() + begin, last - begin},
              tile->values.data() + begin * static_cast<size_t>(width)};
    }
  };
  TileRun runFrom(int x, int y) const;
  size_t firstTileOf(int y) const;
  std::unique_ptr<Compositor> takeCompositor();
  struct TileNoise {
    PixelNoise sums;
    int lit = 0;  ///< Pixels with light.
  };
  TileNoise noiseOf(const ResolvedTile& tile) const;

  const DeepFrame& frame_;
  const FrameOutput& output_;
  const Options& options_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Compositor>> compositors_;  ///< Those that no thread uses.
  int width_;
  std::vector<ExtraFloat> extras_;
  std::vector<std::unique_ptr<ResolvedTile>> resolved_;
  std::vector<TileNoise> noise_;  ///< Of each tile.
  size_t forgotten_ = 0;          ///< Of these, from the first.
};

}  // namespace tomales
