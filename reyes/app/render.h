// `tomales render`: every frame of a RIB stream through the stages, to files.
#pragma once
#include "reyes/app/settings.h"

namespace tomales {

enum ExitCode { kDone = 0, kUsage = 1, kUnreadable = 2, kIncomplete = 3, kUnwritable = 4 };

int renderCommand(const RenderSettings& settings);
/// The same stream, to a .dfb for each frame.
int hideCommand(const RenderSettings& settings);

/// The exit code that a log stands for.
ExitCode exitCodeOf(const Log& log);

}  // namespace tomales
