// Why a frame shows nothing: the first question of whoever looks at a black picture.
#pragma once
#include "reyes/base/log.h"
#include "reyes/scene.h"

namespace tomales {

/// For a frame in which no micropolygon was seen: reports where everything is, or who hides it. A frame that crops may
/// well be empty: silent.
void explainEmptyFrame(const Scene& scene, Log& log);

}  // namespace tomales
