// Options of the command line that have no effect on a frame.
#pragma once
#include "reyes/app/settings.h"

namespace tomales {

/// Warns of each option about stored light, photons and animations that is given, and that nothing in this frame reads.
void warnOfUnusedOptions(const RenderSettings& settings, const GiMethod& method, Log& log);

}  // namespace tomales
