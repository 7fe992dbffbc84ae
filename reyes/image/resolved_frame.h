// Private to reyes/image: the contributions of a frame's pixels, kept tile by tile as long as rows of pixels need them.
#pragma once
#include <memory>
#include <mutex>
#include <span>

#include "reyes/image.h"
#include "reyes/image/composite.h"

namespace tomales {

/// Threads: tiles may be resolved concurrently, and read once they are resolved.
class ResolvedFrame {
 public:
  ResolvedFrame(const DeepFrame& frame, const FrameOutput& output, const Options& options);

  int width() const { return width_; }  ///< Floats of a contribution.
  const std::vector<ExtraFloat>& extras() const { return extras_; }

  void resolve(size_t index, const DeepTile& tile);
  /// Resolves those tiles of the frame that rows [y0, y1) touch and that are not resolved yet.
  void resolveRows(int y0, int y1);
  /// Drops the tiles above a row.
  void forgetAbove(int y);
  /// Tells whether all tiles from row y on are still in memory.
  bool reaches(int y) const { return firstTileOf(y) >= forgotten_; }
  /// Returns the noise of all tiles that have been resolved. It is zero where so few pixels have light that most are
  /// edges.
  PixelNoise noise() const;

  /// The contributions of a pixel.
  struct Seen {
    std::span<const Contribution> list;
    const float* values;  ///< width() floats for each; ResolvedTile::kMargin more may be read.
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
    const ResolvedTile* tile;  ///< Null if the pixels see nothing.
    size_t pixel;              ///< Index of the first of them in the tile.
    int end;                   ///< The x after the last of them.

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
    int lit = 0;  ///< Number of pixels with light.
  };
  /// `width`: floats of a contribution; `samples`: samples of a pixel.
  static TileNoise noiseOf(const ResolvedTile& tile, int width, int samples);

  const DeepFrame& frame_;
  const FrameOutput& output_;
  const Options& options_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Compositor>> compositors_;  ///< Compositors that no thread uses at the moment.
  int width_;
  std::vector<ExtraFloat> extras_;
  std::vector<std::unique_ptr<ResolvedTile>> resolved_;
  std::vector<TileNoise> noise_;  ///< Indexed by tile.
  size_t forgotten_ = 0;          ///< Number of tiles that have been dropped, from the first.
};

}  // namespace tomales
