// tomales chart: plots error against time and memory on the user's own scene, for every method and over its settings.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reyes/base/trust.h"

namespace tomales {

struct ChartSettings {
  std::vector<std::string> files;  ///< The files of one RIB stream.
  std::string output;              ///< FILE.html; figures go to FILE.json beside it.
  std::string sweep = "gi";        ///< One of chartSweepNames().
  std::string folder;              ///< Folder of what has been measured; if empty, it is in the user's cache.
  double budget_s = 600;           ///< Wall time after which no further rendering starts, and a running one ends.
  std::optional<std::array<int, 2>> format;
  int batches = 32;  ///< The most independent pictures of the reference, at least 2.
  int bounces = 0;   ///< If 0, as the scene's indirect light asks.
  int threads = 0;   ///< Threads of each rendering; if 0, as many as the machine has.
  Trust trust;       ///< Says which code that the RIB names may run.
};

/// Returns the arguments that every rendering has beside the scene: --format, --bounces, -t, and those of trust.
std::vector<std::string> sharedArguments(const ChartSettings& settings);

/// Joins arguments to a command as a shell would take it.
std::string joined(const std::vector<std::string>& arguments);

/// Returns the user's folder for measurements.
std::string chartCacheFolder();

int chartCommand(const ChartSettings& settings);

}  // namespace tomales
