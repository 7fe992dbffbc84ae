// tomales chart: what error a second and a megabyte buy, on the user's own scene, for every method and over its
// settings.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reyes/base/trust.h"

namespace tomales {

struct ChartSettings {
  std::vector<std::string> files;  ///< One RIB stream.
  std::string output;              ///< FILE.html; figures go to FILE.json beside it.
  std::string sweep = "gi";        ///< One of chartSweepNames().
  std::string folder;              ///< Of what has been measured; empty: the user's cache.
  double budget_s = 600;           ///< Wall time after which no further rendering starts, and a running one ends.
  std::optional<std::array<int, 2>> format;
  int batches = 32;  ///< Most independent pictures of the reference, at least 2.
  int bounces = 0;   ///< 0: as the scene's indirect light asks.
  int threads = 0;   ///< Of each rendering. 0: as many as the machine has.
  Trust trust;       ///< Of the code that the RIB names.
};

/// What every rendering is told beside the scene: --format, --bounces, -t, whose code may run.
std::vector<std::string> sharedArguments(const ChartSettings& settings);

/// As a shell would take them.
std::string joined(const std::vector<std::string>& arguments);

/// The user's, for what has been measured.
std::string chartCacheFolder();

int chartCommand(const ChartSettings& settings);

}  // namespace tomales
