// Gives the intensity of area lights the meaning that BMRT gave it.
#pragma once
#include "reyes/scene.h"

namespace tomales {

class ShaderRegistry;

/// Tells area lights the area of their geometry by their parameter with TM_ROLE_AREA, unless the scene gives it, so
/// that their light falls off with the square of the distance whatever their size. It does so with Option "shade"
/// "arealight" "bmrt", or in a scene that was made for BMRT. `log` is told where that is a guess. Call it before a
/// ShadingSystem is made of the scene.
void measureAreaLights(Scene& scene, ShaderRegistry& registry, Log& log);

}  // namespace tomales
