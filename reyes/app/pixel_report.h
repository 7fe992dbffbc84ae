// What the samples of one pixel see, for those who wonder why it looks as it does (--pixel).
#pragma once
#include <string>

#include "reyes/deep.h"

namespace tomales {

/// A line for each fragment, nearest first, and the colour of the pixel before any filter. Pre: the tile is shaded, its
/// points still there, and has the pixel.
std::string pixelReport(const DeepTile& tile, int x, int y, int samplesPerPixel, const Scene& scene);

}  // namespace tomales
