// When the polygons of rays have motion keys. Embree takes keys at equal distances over the shutter.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// Do rays with a time exist? Only then is motion worth its memory.
bool raysHaveTimes(const Scene& scene);

/// For each of scene.groups the times of its motion keys, shutter open first: equally spaced, and as few as meet every
/// key of its objects. One for what stands still, for area lights, and for all where no rays have times.
std::vector<std::vector<float>> rayTimes(const Scene& scene);

}  // namespace tomales
