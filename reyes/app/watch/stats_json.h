// Stats and messages as the JSON object of --stats. Keys may be added; farms rely on those that exist.
#pragma once
#include <string>

#include "reyes/app/watch/run_report.h"

namespace tomales {

/// `indent` is that of nlohmann::json::dump(): negative for a single line.
std::string statsText(const RenderSettings& settings, const Stats& stats, const RunFigures& figures, int indent);

/// Returns the same on one line of at most kStatisticsRoom bytes, without messages and the command's paths, and without
/// the figures of single shaders if there are too many of them.
std::string statsOfHeader(const RenderSettings& settings, const Stats& stats, const RunFigures& figures);

/// Prints a table of the cost of each shader, the most expensive first, to standard output. Times include lights and
/// rays that it asked for, and are summed over threads.
void printShaderProfile(const Stats& stats);

}  // namespace tomales
