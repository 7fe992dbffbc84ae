// The picture of a frame: its tiles are shaded as the rows of the Displays need them, and written.
#pragma once
#include "reyes/app/frame/frame_job.h"

namespace tomales {

/// Shades hidden tiles and writes their picture. After an interrupt it still writes what is finished; a second
/// interrupt ends it.
void writePicture(FrameJob& job, const DeepFrame& layout,
                  const std::function<std::optional<DeepTile>(size_t tile)>& load);
/// Hides and shades tiles as the rows of the picture need them, and writes it. `find` returns the tiles of an
/// interrupted run; `keep` keeps those of this one.
void hideAndWritePicture(FrameJob& job, const DeepFrame& layout,
                         const std::function<std::optional<DeepTile>(size_t tile)>& find,
                         const std::function<void(size_t tile, const DeepTile&)>& keep);

}  // namespace tomales
