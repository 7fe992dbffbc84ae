// Stats and Log as the JSON object of --stats. Keys may be added; farms rely on those that exist.
#pragma once
#include <string>

#include "reyes/app/settings.h"
#include "reyes/base/stats.h"

namespace tomales {

/// Writes settings.statsFile. `total_s`: wall time so far. Failure is reported to
/// the log.
void writeStats(const RenderSettings& settings, const Stats& stats, double total_s, Log& log);

/// At the end of a run: the same and, for --profile-shaders, a table of what each shader has cost, the most expensive
/// first, to standard output. Times include lights and rays that it asked for, and are summed over threads.
void writeLastStats(const RenderSettings& settings, const Stats& stats, double total_s, Log& log);

}  // namespace tomales
