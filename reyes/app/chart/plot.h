// Charts of a page: what they show. Chart.js, which is in the page, draws them.
#pragma once
#include <string>
#include <vector>

namespace tomales {

struct PlotPoint {
  double x, y;
  std::string tip;      ///< Shown when pointed at.
  std::string link;     ///< Target of a click.
  bool best = false;    ///< Nothing else is both cheaper and more accurate.
  bool warned = false;  ///< Drawn with a red ring.
  std::string name{};   ///< Written beside it.
  double interval = 0;  ///< Half the interval of y.
};

struct PlotCurve {
  std::string name;
  std::vector<PlotPoint> points;
};

/// Curves on logarithmic axes.
struct Plot {
  std::string title, xLabel, yLabel;
  std::vector<PlotCurve> curves;
  double floor = 0;  ///< Noise of the reference, drawn as a line; 0 if there is none.
  double limit = 0;  ///< An upright line at this x, with its name; 0 if there is none.
  std::string limitName{};
};

/// A figure that may have either sign, with its interval.
struct PlotDifference {
  std::string name;
  size_t curve;  ///< The curve whose colour it has.
  double mean, interval;
};

/// Returns the scripts that a page needs once, if it has any drawing.
std::string plotScripts();
std::string drawPlot(const Plot& plot);
/// Draws shares below each other on a linear axis, with a line at 0.
std::string drawDifferences(const std::string& title, const std::vector<PlotDifference>& rows);
/// Returns the colour of a curve, by its index.
const char* plotColor(size_t curve);

}  // namespace tomales
