// Composer: the order of the Reyes stages. Each function is a pass that reads one noun and leaves the next.
//   FrameHider   Scene -> DeepTile      split, dice, displace, hide, bucket by bucket
//   shadeTiles   DeepTile -> DeepTile   surface and light shaders over visible points
//   writeFrame   DeepFrame -> files     filter, expose, imager shader (in this order: RISpec imaging pipeline), every
//                                       Display; by bands of rows, for which it asks for the tiles that it needs
#pragma once
#include <functional>
#include <span>

#include "reyes/base/stop.h"
#include "reyes/deep.h"
#include "reyes/image.h"
#include "reyes/shade.h"

namespace tomales {

/// Called after every finished bucket with the fraction of this pass, 0..1. May be called from any thread.
using Progress = std::function<void(float fraction)>;

struct FrameControl {
  Progress progress;
  StopToken stop{};  ///< Once it asks, running buckets are given up, and the pass returns.
  uint32_t seed = 0;
  PluginTrust trust{};  ///< Decides where display drivers may be loaded from.
};

/// Receives hidden tiles, from any thread.
struct TileSink {
  /// Tells whether the tile is there already, so that it need not be hidden. If this function is empty, no tile is.
  std::function<bool(size_t tile)> has;
  std::function<void(size_t tile, DeepTile&&)> take;
  /// Returns the tile if an interrupted run has left it. May be empty.
  std::function<std::optional<DeepTile>(size_t tile)> find;
};

/// Provides the tiles for the shaders and receives them, from any thread.
struct TileAccess {
  /// Returns false if the tile is to be skipped. A tile that has colours keeps them.
  std::function<bool(size_t index, DeepTile& tile)> load;
  /// Called with the shaded tile, whose points are still there.
  std::function<void(size_t index, DeepTile&& tile)> take;
};

/// Returns the layout of a frame's buckets, without tiles.
DeepFrame layOutFrame(const Scene& scene);

/// Hides the buckets of a frame, some at a time.
class FrameHider {
 public:
  /// All arguments must outlive it. It opens the scene's procedurals as buckets come to them, and drops their geometry
  /// after the last bucket. If tiles are written to a file before the last one is hidden, open all procedurals first:
  /// otherwise the file's list of groups would miss those that are found later.
  FrameHider(const DeepFrame& layout, Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats,
             Log& log);
  ~FrameHider();  ///< Warns of uncertain results.
  /// Hides each bucket once, in any order. Returns false if it was stopped before all were hidden. Threads begin far
  /// apart in the list: those that hide neighbours wait for each other to open nodes that touch both.
  bool hide(std::span<const uint32_t> buckets, const TileSink& sink);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
/// Hides all tiles, in the scene's bucket order.
bool hideTiles(const DeepFrame& layout, Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats,
               Log& log, const TileSink& sink);
DeepFrame hideFrame(Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log);

/// Returns the tiles that the picture of frame.crop needs, in bucket order.
std::vector<uint32_t> tilesOf(const DeepFrame& frame, const Options& options);
/// Runs surface shaders, lights and the atmosphere over the points of a tile.
void shadeTile(DeepTile& tile, const Scene& scene, const ShadingSystem& shading, const ShadeContext& context);
/// Shades tiles, started in the order given. Returns false if stopped: tiles that were being shaded then are dropped,
/// because parts of them may be missing.
bool shadeTiles(std::span<const uint32_t> tiles, const TileAccess& access, const Scene& scene,
                const ShadingSystem& shading, const ShadeContext& context, const FrameControl& control);

/// Runs the imager shader, if there is one, over all pixels of the image, in place.
void runImager(Image& image, const ShadingSystem& shading);

/// Takes a shaded tile for the picture; called from any thread.
using TilePlace = std::function<void(size_t index, DeepTile&& tile)>;
/// Calls `place` for some of these tiles. The others are left out of the picture.
using TileFill = std::function<void(std::span<const uint32_t> tiles, const TilePlace& place)>;
/// Receives the rows that go to the Displays. May be empty.
using RowViewer = std::function<void(const Image& rows)>;
/// Writes the picture in bands of rows, from the top. For each band it asks for the tiles that are needed and not there
/// yet, column by column. Each tile is asked for once, and dropped when no lower row needs it. A Display that cannot be
/// written is reported; the other Displays are written all the same.
void writeFrame(DeepFrame& frame, const TileFill& fill, const RowViewer& viewer, const Scene& scene,
                const ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log);
/// Passes the same rows to the viewer alone, before exposure and imager, and writes no files.
void showFrame(DeepFrame& frame, const TileFill& fill, const RowViewer& viewer, const Options& options,
               const FrameControl& control);

}  // namespace tomales
