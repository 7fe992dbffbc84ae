// Warns where a method reaches its limits on the scene at hand; docs/measured/limits.md shows what happens beyond them.
#pragma once
#include <span>

#include "gi/services.h"
#include "reyes/base/log.h"
#include "reyes/scene.h"

namespace tomales {

/// Warns once, with the first such object, if the camera is so far from the origin that rounding of floats moves points
/// by a good part of a pixel.
void warnOfFloatRange(const Scene& scene, Log& log);

/// Warns once, with the first such object, if micropolygons of a surface that is not flat are so large that outlines
/// have corners.
void warnOfCoarseDicing(const Scene& scene, Log& log);

/// Warns if more than half of the irradiance records have a relative standard error of luminance of a tenth or more.
/// For records darker than a tenth of the mean, the error is relative to that tenth. Also warns if the error of their
/// light as a whole is a quarter, because few rays bring it.
void warnOfNoise(std::span<const PreparedCache> caches, Log& log);

/// Warns once for each group that rays leave by guesses (RayScene::starts): its walls are thinner than rays can tell.
void warnOfThinWalls(const RayScene& rays, Log& log);

}  // namespace tomales
