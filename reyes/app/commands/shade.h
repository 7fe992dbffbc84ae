// `tomales shade` and `tomales gather`: make a picture, or an irradiance cache, from the .dfb of a shot.
#pragma once
#include "reyes/app/settings.h"

namespace tomales {

int shadeCommand(const RenderSettings& settings);
int gatherCommand(const RenderSettings& settings);

}  // namespace tomales
