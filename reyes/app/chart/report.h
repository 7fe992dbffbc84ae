// What a chart has found, and the two files that say it.
#pragma once
#include <set>

#include "reyes/app/chart/error.h"
#include "reyes/app/chart/lab.h"

namespace tomales {

/// One setting of one method.
struct ChartPoint {
  size_t curve;
  std::string setting;  ///< In short.
  double value;         ///< Of what varies along the curve; 0: not one number.
  std::string commandLine;
  Run run;
  ErrorFigures error;
  bool bestInTime = false, bestInMemory = false;  ///< No other point is cheaper and more accurate.
  std::string picture, errorMap;                  ///< PNG files of thumbnails.
};

struct ChartReport {
  bool oneKnob = false;  ///< Curves vary one number: ChartPoint::value.
  std::string scene, title, commandLine, referenceCommandLine;
  std::vector<std::string> curves;
  std::vector<ChartPoint> points;    ///< Curve by curve, as the sweep has them.
  std::vector<std::string> missing;  ///< What the budget or a failure left out, and why.
  std::set<std::string> warnings;    ///< Codes of what any of the renderings warned of.
  int referenceBatches = 0;
  double noiseFloor = 0, referenceSeconds = 0, budget_s = 0;
  std::string referencePicture;
  float mapRange = 0.1f;  ///< Relative error of full colour.
};

void markBest(ChartReport& report);
/// Seconds at which a curve reaches an error, on straight lines between its points in logarithmic axes; nothing if it
/// does not.
std::optional<double> secondsToReach(const ChartReport& report, size_t curve, double error);

/// All its points have the same error: what its settings change is the cost, if they reach this scene at all.
bool isFlat(const ChartReport& report, size_t curve);

// False: they could not be written.
bool writeChartPage(const std::string& path, const ChartReport& report);
bool writeChartJson(const std::string& path, const ChartReport& report);

}  // namespace tomales
