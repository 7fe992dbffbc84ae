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
  bool warned;           ///< The renderer said what the scene's limit names.
};

struct StabilityCurve {
  LabScene scene;
  std::vector<StabilityPoint> points;  ///< Method by method, harmless first.
  std::vector<std::string> truths;     ///< Thumbnails, one for each value of the knob; empty: not measured.
  double noiseFloor = 0;               ///< The worst of all truths.
  std::vector<std::string> missing;    ///< What the budget or a failure left out, and why.
};

/// ChartSettings::files are the scenes; folders stand for all that is in them.
int stabilityCommand(const ChartSettings& settings);

// False: they could not be written.
bool writeStabilityPage(const std::string& path, const std::vector<StabilityCurve>& curves,
                        const std::string& commandLine);
bool writeStabilityJson(const std::string& path, const std::vector<StabilityCurve>& curves,
                        const std::string& commandLine);

}  // namespace tomales
