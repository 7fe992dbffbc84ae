// Verb: what photons meet in a world -> a number that changes with it. What was computed from a world names it by that.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// Of the objects that photons may meet, their attributes, transformations and shaders, the lights, named spaces and
/// the files that shaders name (by size and time of change). Not of the camera and the frame, of line numbers, or of
/// the order of objects. Pre: procedurals that photons meet are open. photonsOnly false: of all objects.
uint64_t worldSum(const Scene& scene, bool photonsOnly = true);

}  // namespace tomales
