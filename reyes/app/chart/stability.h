// tomales chart --stability: how wrong each method becomes as a knob is turned, for every scene of a laboratory.
#pragma once
#include "reyes/app/chart/chart.h"
#include "reyes/app/chart/error.h"
#include "reyes/app/chart/lab.h"
#include "reyes/app/chart/lab_scene.h"

namespace tomales {

/// One method at one value of the knob.
struct StabilityPoint {
  size_t method;
  std::string knob;
  ErrorFigures error;
  Run run;
  std::string commandLine;
  std::string errorMap;  ///< PNG file of a thumbnail.
  bool warned;           ///< True if the renderer gave the warning that the scene's limit names.
};

struct StabilityCurve {
  LabScene scene;
  std::vector<StabilityPoint> points;  ///< Method by method, harmless first.
  std::vector<std::string> truths;     ///< Thumbnails, one for each value of the knob; empty if not measured.
  double noiseFloor = 0;               ///< The worst noise floor of all truths.
  std::vector<std::string> missing;    ///< The points that the budget or a failure left out, and why.
};

/// ChartSettings::files are the scenes; a folder stands for all scenes in it.
int stabilityCommand(const ChartSettings& settings);

// Returns false if the page could not be written.
bool writeStabilityPage(const std::string& path, const std::vector<StabilityCurve>& curves,
                        const std::string& commandLine);
bool writeStabilityJson(const std::string& path, const std::vector<StabilityCurve>& curves,
                        const std::string& commandLine);

}  // namespace tomales
