// `tomales render`: every frame of a RIB stream through the stages, to files.
#pragma once
#include "reyes/app/exit_code.h"
#include "reyes/app/settings.h"

namespace tomales {

int renderCommand(const RenderSettings& settings);
/// The same stream, to a .dfb for each frame.
int hideCommand(const RenderSettings& settings);

}  // namespace tomales
