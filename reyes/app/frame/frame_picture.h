// The picture of a frame: its tiles are shaded as the rows of the Displays need them, and written.
#pragma once
#include "reyes/app/frame/frame_job.h"

namespace tomales {

/// Writes the picture of tiles that are hidden. If hiding was interrupted, writing is not again.
void writePicture(FrameJob& job, const DeepFrame& layout,
                  const std::function<std::optional<DeepTile>(size_t tile)>& load);
/// Writes the picture of tiles that are hidden, too, as its rows need them. `find` returns the tiles of an interrupted
/// run; `keep` keeps those of this one.
void hideAndWritePicture(FrameJob& job, const DeepFrame& layout,
                         const std::function<std::optional<DeepTile>(size_t tile)>& find,
                         const std::function<void(size_t tile, const DeepTile&)>& keep);

}  // namespace tomales
