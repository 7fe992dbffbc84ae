// Private to gi: the gather pass over the tiles of a frame before it is shaded. Space: current.
#pragma once
#include "gi/frame/state.h"
#include "reyes/base/stop.h"

namespace tomales {

/// Implements GiServices::gatherPass().
void fillCaches(GiState&, const DeepFrame& layout, const TileReader&, const std::function<void(float)>& progress,
                StopToken stop, const std::function<void(int stride)>& covered);

}  // namespace tomales
