// Gives the intensity of area lights the meaning that BMRT gave it.
#pragma once
#include "reyes/scene.h"

namespace tomales {

class ShaderRegistry;

/// Sets the parameter with TM_ROLE_AREA of each area light to the area of its geometry, unless the scene gives it. The
/// light then falls off with the square of the distance, whatever the size of the geometry. This happens only with
/// Option "shade" "arealight" "bmrt", or in a scene that was made for BMRT. `log` is told where that is a guess. Call
/// it before a ShadingSystem is made of the scene.
void measureAreaLights(Scene& scene, ShaderRegistry& registry, Log& log);

}  // namespace tomales
