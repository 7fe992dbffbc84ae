// Gives the intensity of arealight the meaning that BMRT gave it.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// Option "shade" "arealight" "bmrt", or a scene that was made for BMRT: arealights are told the area of their geometry
/// (parameter "area"), unless they say it themselves, so that their light falls off with the square of the distance
/// whatever their size.
void measureAreaLights(Scene& scene);

}  // namespace tomales
