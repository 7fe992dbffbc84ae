// `tomales shade` and `tomales gather`: a shot's .dfb -> its picture, or its irradiance cache.
#pragma once
#include "reyes/app/settings.h"

namespace tomales {

int shadeCommand(const RenderSettings& settings);
int gatherCommand(const RenderSettings& settings);

}  // namespace tomales
