// Explains why a frame shows nothing, which is the first question about a black picture.
#pragma once
#include "reyes/base/log.h"
#include "reyes/scene.h"

namespace tomales {

/// Reports, for a frame in which no micropolygon was seen, where the objects are, or what hides them. It says nothing
/// about a cropped frame, which may well be empty.
void explainEmptyFrame(const Scene& scene, Log& log);

/// Tells whether CropWindow holds a pixel. A window that is narrower than a pixel may lie between two centres; such a
/// frame has no picture, which is reported (RISpec 4.1.1 gives the pixels of a window).
bool cropHasPixels(const Scene& scene, Log& log);

}  // namespace tomales
