// Composer: the order of the Reyes stages. Each function is a pass that reads one noun and leaves the next.
//   hideFrame    Scene -> DeepFrame     split, dice, displace, hide, bucket by bucket
//   shadeFrame   DeepFrame -> DeepFrame surface and light shaders over visible points
//   imageOf      DeepFrame -> Image     filter
//   runImager    Image -> Image         imager shader; after exposure (RISpec imaging pipeline)
//   writeFrame   DeepFrame -> files     the last three and every Display, a band of rows at a time
#pragma once
#include <atomic>
#include <functional>

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
  std::function<bool(size_t tile)> has;               ///< It is there already and need not be hidden. Empty: none is.
  std::function<void(size_t tile, DeepTile&&)> take;
  std::function<std::optional<DeepTile>(size_t tile)> find;  ///< What an interrupted run has left of it. May be empty.
};

/// Where tiles to shade come from, from any thread.
struct TileSource {
  std::function<bool(size_t index, DeepTile& tile)> load;      ///< False: the tile is left out of the picture.
  std::function<void(size_t index, DeepTile& tile)> finished;  ///< Shaded, its points still there. May be empty.
};

/// The buckets of a frame, nothing in them.
DeepFrame layOutFrame(const Scene& scene);
/// Opens the scene's procedurals as buckets come to them, and drops their geometry behind the last. Where tiles leave before the
/// last is hidden, groups that are found on the way are missed: open all procedurals first. False: cancelled, some tiles were
/// not hidden.
bool hideTiles(const DeepFrame& layout, Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log,
               const TileSink& sink);
DeepFrame hideFrame(Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log);
void shadeFrame(DeepFrame& frame, const Scene& scene, const ShadingSystem& shading, const ShadeContext& context,
                const FrameControl& control, Stats& stats);
/// The tiles that the picture of frame.crop needs, in bucket order.
std::vector<uint32_t> tilesOf(const DeepFrame& frame, const Options& options);
/// Surface shaders, lights and atmosphere over the points of a tile.
void shadeTile(DeepTile& tile, const Scene& scene, const ShadingSystem& shading, const ShadeContext& context);
/// Loads, shades and strips of their points the tiles that the picture of frame.crop needs.
void shadeTiles(DeepFrame& frame, const TileSource& source, const Scene& scene, const ShadingSystem& shading,
                const ShadeContext& context, const FrameControl& control, Stats& stats);
Image imageOf(const DeepFrame& frame, const Scene& scene, const FrameControl& control, Stats& stats);
void runImager(Image& image, const ShadingSystem& shading);
/// What cannot be written is reported; the other Displays are written all the same.
void writeFrame(const DeepFrame& frame, const Scene& scene, const ShadingSystem& shading, const FrameControl& control, Log& log);

}  // namespace tomales
