// Describes what the samples of one pixel see, for users who wonder why it looks as it does (--pixel).
#pragma once
#include <string>

#include "reyes/deep.h"

namespace tomales {

/// Returns a line for each fragment, nearest first, and the colour of the pixel before any filter. Pre: the tile has
/// the pixel, is shaded, and still has its points.
std::string pixelReport(const DeepTile& tile, int x, int y, int samplesPerPixel, const Scene& scene);

}  // namespace tomales
