// The results of a chart, and the two files that hold them.
#pragma once
#include <set>

#include "reyes/app/chart/error.h"
#include "reyes/app/chart/lab.h"

namespace tomales {

/// One setting of one method.
struct ChartPoint {
  size_t curve;
  std::string setting;  ///< The setting in few words.
  double value;         ///< Value of the number that varies along the curve; 0 if it is not one number.
  std::string commandLine;
  Run run;
  ErrorFigures error;
  bool bestInTime = false, bestInMemory = false;  ///< No other point is cheaper and more accurate.
  std::string picture, errorMap;                  ///< PNG files of thumbnails.
};

struct ChartReport {
  bool oneKnob = false;  ///< True if curves vary one number: ChartPoint::value.
  std::string scene, title, commandLine, referenceCommandLine;
  std::vector<std::string> curves;
  std::vector<ChartPoint> points;    ///< Curve by curve, in the order of the sweep.
  std::vector<std::string> missing;  ///< The points that the budget or a failure left out, and why.
  std::set<std::string> warnings;    ///< Codes of the warnings of any rendering.
  int referenceBatches = 0;
  double noiseFloor = 0, referenceSeconds = 0, budget_s = 0;
  std::string referencePicture;
  float mapRange = 0.1f;   ///< Relative error that has the full colour.
  float pictureWhite = 1;  ///< The value that is white in the thumbnails.
};

void markBest(ChartReport& report);
/// Returns the seconds at which a curve reaches an error, on straight lines between its points in logarithmic axes, or
/// nothing if it does not.
std::optional<double> secondsToReach(const ChartReport& report, size_t curve, double error);

/// Returns the point of a curve with the least error; null if it has none. With an index past all curves it looks among
/// all points.
const ChartPoint* mostAccurate(const ChartReport& report, size_t curve);

/// Tells whether all points of the curve have the same error. Its settings then change only the cost, if they affect
/// this scene at all.
bool isFlat(const ChartReport& report, size_t curve);

// Both return false if the file could not be written.
bool writeChartPage(const std::string& path, const ChartReport& report);
bool writeChartJson(const std::string& path, const ChartReport& report);

}  // namespace tomales
