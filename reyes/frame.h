// Composer: the order of the Reyes stages. Each function is a pass that reads one noun and leaves the next.
//   FrameHider   Scene -> DeepTile      split, dice, displace, hide, bucket by bucket
//   shadeTiles   DeepTile -> DeepTile   surface and light shaders over visible points
//   writeFrame   DeepFrame -> files     filter, expose, imager shader (in this order: RISpec imaging pipeline), every
//   Display; a band of
//                                       rows at a time, for which it asks for the tiles that it needs
#pragma once
#include <atomic>
#include <functional>
#include <span>

#include "reyes/deep.h"
#include "reyes/image.h"
#include "reyes/shade.h"

namespace tomales {

/// Told after every finished bucket: fraction of this pass, 0..1. May be called from any thread.
using Progress = std::function<void(float fraction)>;

struct FrameControl {
  Progress progress;
  const std::atomic<bool>* cancelled = nullptr;  ///< Set from a signal handler: give up running buckets and return.
  uint32_t seed = 0;
};

/// Where hidden tiles go, from any thread.
struct TileSink {
  std::function<bool(size_t tile)> has;  ///< It is there already and need not be hidden. Empty: none is.
  std::function<void(size_t tile, DeepTile&&)> take;
  std::function<std::optional<DeepTile>(size_t tile)> find;  ///< What an interrupted run has left of it. May be empty.
};

/// Tiles on their way through the shaders, from any thread.
struct ShadeSteps {
  std::function<bool(size_t index, DeepTile& tile)> load;   ///< False: it is passed over.
  std::function<void(size_t index, DeepTile&& tile)> take;  ///< Shaded, its points still there.
};

/// The buckets of a frame, holding none.
DeepFrame layOutFrame(const Scene& scene);

/// Hides the buckets of a frame, some at a time.
class FrameHider {
 public:
  /// Everything must outlive it. Opens the scene's procedurals as buckets come to them, and drops their geometry behind
  /// the last. Where tiles leave before the last is hidden, groups that are found on the way are missed by what lists
  /// all of them: open all procedurals first.
  FrameHider(const DeepFrame& layout, Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats,
             Log& log);
  ~FrameHider();  ///< Warns of what is doubtful in what was hidden.
  /// Each bucket once, in any order. False: cancelled, some were not hidden. Threads begin far apart in the list: those
  /// that hide neighbours wait for each other to open what touches both.
  bool hide(std::span<const uint32_t> buckets, const TileSink& sink);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
/// All, in the scene's bucket order.
bool hideTiles(const DeepFrame& layout, Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats,
               Log& log, const TileSink& sink);
DeepFrame hideFrame(Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log);

/// The tiles that the picture of frame.crop needs, in bucket order.
std::vector<uint32_t> tilesOf(const DeepFrame& frame, const Options& options);
/// Surface shaders, lights and atmosphere over the points of a tile.
void shadeTile(DeepTile& tile, const Scene& scene, const ShadingSystem& shading, const ShadeContext& context);
/// Starts them in the order given. False: cancelled.
bool shadeTiles(std::span<const uint32_t> tiles, const ShadeSteps& steps, const Scene& scene,
                const ShadingSystem& shading, const ShadeContext& context, const FrameControl& control);

void runImager(Image& image, const ShadingSystem& shading);

/// Takes a shaded tile for the picture; from any thread.
using TilePlace = std::function<void(size_t index, DeepTile&& tile)>;
/// Calls `place` for some tiles. Others are left out of the picture.
using TileFill = std::function<void(std::span<const uint32_t> tiles, const TilePlace& place)>;
/// Sees the rows that go to the Displays. May be empty.
using RowViewer = std::function<void(const Image& rows)>;
/// Asks for the tiles that the next rows of the picture need, each once, in bands of rows from the top and there column
/// by column, and forgets those that no row needs any more. What cannot be written is reported; the other Displays are
/// written all the same.
void writeFrame(DeepFrame& frame, const TileFill& fill, const RowViewer& viewer, const Scene& scene,
                const ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log);

}  // namespace tomales
