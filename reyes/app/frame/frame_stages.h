// Stages of a prepared frame that leave no picture in a file.
#pragma once
#include "reyes/app/frame/frame_job.h"
#include "reyes/base/stop.h"

namespace tomales {

/// Hides all buckets, and opens the procedurals that it meets. Returns false if it was interrupted.
bool hideBuckets(FrameJob& job, const DeepFrame& layout, const TileSink& sink);
/// Shades some buckets. Returns false if it was interrupted.
bool shadeBuckets(FrameJob& job, std::span<const uint32_t> tiles, const TileAccess& access);

/// The light in which a part of a frame is shown.
struct ShownLight {
  const std::string* lights = nullptr;  ///< ShadeContext::onlyLightGroup.
  bool indirect = true;
};
/// The tiles of showWindow(), from any thread.
struct ShownTiles {
  std::function<bool(size_t index, DeepTile& tile)> load;  ///< See TileAccess::load.
  std::function<void(size_t index, const DeepTile& tile)> shaded;
};
/// Shades the window of the frame for the viewer alone, before exposure and imager. It can be called again and again.
/// If it is stopped, the viewer may get no rows.
void showWindow(FrameJob& job, const DeepFrame& layout, const PixelRect& window, const ShownTiles& tiles,
                const ShownLight& light, const RowViewer& viewer, StopToken stop);
/// Shades tiles that are no picture.
void shadeApart(FrameJob& job, std::span<DeepTile> tiles, const ShownLight& light);

}  // namespace tomales
