#include "reyes/app/chart/plot.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reyes/app/chart/html.h"

namespace tomales {
namespace {

using Json = nlohmann::ordered_json;

// Okabe and Ito's colours, which the colour-blind can tell apart, darkest first.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#000000", "#cc79a7", "#e69f00", "#56b4e9"};

Json of(const PlotPoint& p) {
  return {{"x", p.x},       {"y", p.y},           {"tip", p.tip},   {"link", p.link},
          {"best", p.best}, {"warned", p.warned}, {"name", p.name}, {"interval", p.interval}};
}

/// Returns a canvas and its figures. Within a script no text may end it.
std::string drawing(const Json& figures, int height) {
  std::string text = figures.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return fmt::format(
      "<div class=\"drawing\" style=\"height:{}px\"><canvas role=\"img\" aria-label=\"{}\"></canvas><script "
      "type=\"application/json\">{}</script></div>\n",
      height, escapeXml(figures["title"]), text);
}

}  // namespace

const char* plotColor(size_t curve) { return kColors[curve % std::size(kColors)]; }

std::string plotScripts() {
  return fmt::format("<script>{}</script>\n<script>{}</script>\n", chartFile("chart.min.js"), chartFile("plot.js"));
}

std::string drawPlot(const Plot& plot) {
  constexpr int kHeight_px = 420;
  Json figures{{"title", plot.title}, {"xLabel", plot.xLabel}, {"yLabel", plot.yLabel},
               {"floor", plot.floor}, {"limit", plot.limit},   {"limitName", plot.limitName}};
  for (size_t c = 0; c < plot.curves.size(); ++c) {
    Json points = Json::array();
    for (const PlotPoint& p : plot.curves[c].points) points.push_back(of(p));
    figures["curves"].push_back({{"name", plot.curves[c].name}, {"color", plotColor(c)}, {"points", points}});
  }
  return drawing(figures, kHeight_px);
}

std::string drawDifferences(const std::string& title, const std::vector<PlotDifference>& rows) {
  constexpr int kRow_px = 40, kAxis_px = 40;
  Json figures{{"title", title}, {"rows", Json::array()}};
  for (const PlotDifference& r : rows)
    figures["rows"].push_back(
        {{"name", r.name}, {"color", plotColor(r.curve)}, {"mean", r.mean}, {"interval", r.interval}});
  return drawing(figures, kRow_px * static_cast<int>(rows.size()) + kAxis_px);
}

}  // namespace tomales
