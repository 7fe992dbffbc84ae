// Explains why a frame shows nothing: the first question about a black picture.
#pragma once
#include "reyes/base/log.h"
#include "reyes/scene.h"

namespace tomales {

/// Reports, for a frame in which no micropolygon was seen, where the objects are, or what hides them. It says nothing
/// of a frame that crops, which may well be empty.
void explainEmptyFrame(const Scene& scene, Log& log);

}  // namespace tomales
