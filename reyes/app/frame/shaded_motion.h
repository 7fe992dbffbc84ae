// Warns where motion changes the light on a moving object: a micropolygon is shaded once, where it is when the shutter
// opens (docs/decisions/0031).
#pragma once
#include "raytrace/trace.h"
#include "reyes/camera.h"

namespace tomales {

class Log;

/// Names the object on which direct light, without its shadows, changes most over the shutter, if the picture is off by
/// more than 15 % there.
void warnOfShadedMotion(const RayScene& rays, const Camera& camera, const ShadingSystem& shading, Log& log);

}  // namespace tomales
