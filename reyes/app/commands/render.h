// `tomales render`: renders every frame of a RIB stream to files.
#pragma once
#include "reyes/app/exit_code.h"
#include "reyes/app/settings.h"

namespace tomales {

int renderCommand(const RenderSettings& settings);
/// Hides the frames of the same stream, to a .dfb each.
int hideCommand(const RenderSettings& settings);

}  // namespace tomales
