// Times of the motion keys of rays' polygons. Embree takes keys at equal distances over the shutter.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// Tells whether rays with a time exist: only then is motion worth its memory.
bool raysHaveTimes(const Scene& scene);

/// Returns the times of the motion keys of each of scene.groups, shutter open first. They are equally spaced, and as
/// few as meet every key of its objects. There is one for objects that stand still, for area lights, and for all where
/// no rays have times.
std::vector<std::vector<float>> motionKeyTimes(const Scene& scene);

}  // namespace tomales
