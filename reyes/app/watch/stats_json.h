// Stats and Log as the JSON object of --stats. Keys may be added; farms rely on those that exist.
#pragma once
#include <string>

#include "reyes/app/settings.h"
#include "reyes/base/stats.h"

namespace tomales {

/// Writes settings.statsFile. `total_s` is the wall time
/// so far. A failure is reported to the log.
void writeStats(const RenderSettings& settings, const Stats& stats, double total_s, Log& log);

/// Writes the same at the end of a run and, for --profile-shaders, prints a table of the cost of each shader, the most
/// expensive first, to standard output. Times include lights and rays that it asked for, and are summed over threads.
void writeLastStats(const RenderSettings& settings, const Stats& stats, double total_s, Log& log);

}  // namespace tomales
