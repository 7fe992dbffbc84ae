// Verb: computes a checksum of everything that photons meet in a world. Files that are computed from a world carry its
// checksum.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// Sums the objects that photons may meet, their attributes, transformations and shaders, the lights and named spaces.
/// Files that shaders name, and the files of shaders, count by size and time of change. Limits of memory and the order
/// of buckets do not count. The sum does not depend on the camera and the frame, on line numbers, or on the order of
/// objects. Pre: procedurals that photons meet are open. Without `photonsOnly` it sums all objects.
uint64_t worldSum(const Scene& scene, bool photonsOnly = true);

/// Sums size and time of change of the files that a texture's name may stand for; 0 if there are none.
uint64_t stampsOfPicture(const std::string& name, const std::string& searchPath);

}  // namespace tomales
