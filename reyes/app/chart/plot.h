// Curves on logarithmic axes, as SVG.
#pragma once
#include <string>
#include <vector>

namespace tomales {

struct PlotPoint {
  double x, y;
  std::string tip;      ///< Shown when pointed at.
  std::string link;     ///< Where a click goes.
  bool best = false;    ///< Nothing else is both cheaper and more accurate.
  bool warned = false;  ///< Drawn with a ring.
  std::string name{};   ///< Written beside it.
};

struct PlotCurve {
  std::string name;
  std::vector<PlotPoint> points;
};

struct Plot {
  std::string title, xLabel, yLabel;
  std::vector<PlotCurve> curves;
  double floor = 0;  ///< Drawn as a line; 0: none.
  double limit = 0;  ///< An upright line at this x, with its name; 0: none.
  std::string limitName{};
};

/// `width`, `height`: in the pixels of the text, which is 12 of them high.
std::string drawPlot(const Plot& plot, int width, int height);
/// Of the curve at this place.
const char* plotColor(size_t curve);
/// Three digits, without an exponent where possible.
std::string shortNumber(double value);
std::string escapeXml(const std::string& text);

}  // namespace tomales
