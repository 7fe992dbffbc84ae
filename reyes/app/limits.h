// Where methods come to their limits on the scene at hand, as warnings; the laboratory of docs/chart.md shows what
// happens beyond.
#pragma once
#include <span>

#include "gi/services.h"
#include "reyes/base/log.h"
#include "reyes/scene.h"

namespace tomales {

/// The camera is so far from the origin that floats place points by a good part of a pixel. Once, with the first object
/// that is.
void warnOfFloatRange(const Scene& scene, Log& log);

/// Micropolygons of something that is not flat are so large that outlines have corners. Once, with the first object
/// that is.
void warnOfCoarseDicing(const Scene& scene, Log& log);

/// More than half of the irradiance records are uncertain by a tenth or more (standard errors of their luminance;
/// darker ones than a tenth of the mean are measured against that); or their light is, by a quarter, because few rays
/// bring it.
void warnOfNoise(std::span<const PreparedCache> caches, Log& log);

/// Rays leave a group by guesses (RayScene::starts): its walls are thinner than rays know where they are. Once a group.
void warnOfThinWalls(const RayScene& rays, Log& log);

}  // namespace tomales
