#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "reyes/app/build_info.h"
#include "reyes/app/chart/html.h"
#include "reyes/app/chart/plot.h"
#include "reyes/app/chart/report.h"
#include "reyes/app/settings.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

constexpr double kAskedErrors[] = {0.08, 0.04, 0.02, 0.01, 0.005};

class Page : Markup {
 public:
  explicit Page(const ChartReport& report) : r_(report) {}

  std::string write(const std::string& jsonName) {
    openPage(r_.scene + ": error against cost", r_.scene + ": " + r_.title);
    summary(jsonName);
    reach();
    put("{}", plotScripts());
    put("<div class=\"plots\">\n");
    plot(
        "Error against CPU time", "CPU seconds of the whole process", [](const ChartPoint& p) { return p.run.cpu_s; },
        [](const ChartPoint& p) { return p.bestInTime; });
    plot(
        "Error against memory", "peak resident memory, MB",
        [](const ChartPoint& p) { return p.run.peakBytes / 1048576; },
        [](const ChartPoint& p) { return p.bestInMemory; });
    if (r_.oneKnob)
      plot(
          "Error against the setting", r_.title.c_str(), [](const ChartPoint& p) { return p.value; },
          [](const ChartPoint&) { return false; });
    put("</div>\n");
    differences();
    table();
    cards();
    closePage();
    return take();
  }

 private:
  std::string key(size_t curve) const {
    return fmt::format("<span class=\"key\" style=\"background:{}\"></span>{}", plotColor(curve),
                       escapeXml(r_.curves[curve]));
  }

  /// Returns the value that varies, where there is room for it: along a single curve.
  std::string nameOf(const ChartPoint& p) const {
    if (r_.curves.size() > 1) return "";
    return p.setting.substr(p.setting.rfind(' ') + 1);
  }

  void summary(const std::string& jsonName) {
    put("<p>Error: mean of |test &minus; reference| / (reference + {}) over all colours of all pixels that the "
        "reference lights, minus what the noise of the reference adds to it. Yellow: the "
        "points that no other beats in both cost and error. Every point leads to its picture.</p>\n",
        ChartReference::kFloor);
    put("<p>The reference is the mean of {} independent pictures ({:.0f} CPU s) of <code>{}</code>; its own noise is "
        "{}.</p>\n",
        r_.referenceBatches, r_.referenceSeconds, escapeXml(r_.referenceCommandLine),
        std::isfinite(r_.noiseFloor) ? percent(r_.noiseFloor) : "unknown");
    put("<p>Figures: <a href=\"{0}\">{0}</a>. Made with tomales {1}: <code>{2}</code></p>\n", escapeXml(jsonName),
        kVersion, escapeXml(r_.commandLine));
    if (!r_.warnings.empty())
      put("<p>The renderer warned of: {}. The command lines below say more.</p>\n",
          escapeXml(fmt::format("{}", fmt::join(r_.warnings, ", "))));
    for (const ChartPoint& p : r_.points)
      if (p.error.notFinite > 0)
        put("<p><strong>{}, {}{}</strong>: in the picture they count as black, in the reference not at all; green in "
            "the error map.</p>\n",
            escapeXml(r_.curves[p.curve]), escapeXml(p.setting), notFiniteNote(p.error));
    if (r_.missing.empty()) return;
    put("<p><strong>Not measured:</strong></p>\n<ul>");
    for (const std::string& m : r_.missing) put("<li>{}</li>", escapeXml(m));
    put("</ul>\n");
  }

  void reach() {
    put("<h2>CPU seconds to reach an error</h2><div class=\"scroll\"><table><tr><th>method</th>");
    for (const double e : kAskedErrors) put("<th>{}</th>", percent(e));
    put("</tr>\n");
    for (size_t c = 0; c < r_.curves.size(); ++c) {
      put("<tr><td>{}</td>", key(c));
      for (const double e : kAskedErrors) {
        const auto seconds = secondsToReach(r_, c, e);
        put("<td{}>{}</td>", isFirst(c, e) ? " class=\"first\"" : "", seconds ? shortNumber(*seconds) : "&ndash;");
      }
      put("</tr>\n");
    }
    put("</table></div>\n");
    for (size_t c = 0; c < r_.curves.size(); ++c)
      if (isFlat(r_, c))
        put("<p>{}: the error is the same for all settings; what they change is the cost, if they reach this scene at "
            "all.</p>\n",
            key(c));
  }

  bool isFirst(size_t curve, double error) const {
    const auto seconds = secondsToReach(r_, curve, error);
    for (size_t c = 0; c < r_.curves.size(); ++c)
      if (const auto other = secondsToReach(r_, c, error); !seconds || (other && *other < *seconds)) return false;
    return seconds.has_value();
  }

  /// Shows the differences of methods. The interval of a difference shows whether a method is worse. The interval of
  /// each method is wider, because it includes the noise of the reference, which all methods share.
  void differences() {
    const ChartPoint* best = mostAccurate(r_, r_.curves.size());
    if (!best || r_.curves.size() < 2) return;
    std::vector<PlotDifference> rows;
    for (size_t c = 0; c < r_.curves.size(); ++c)
      if (const ChartPoint* p = mostAccurate(r_, c); p && p->curve != best->curve) {
        const ErrorDifference d = p->error - best->error;
        rows.push_back({r_.curves[c], c, d.mean, d.confidence});
      }
    put("<h2>Differences</h2><p>By how much the error of each method's most accurate picture exceeds that of {} ({}), "
        "with 95 % intervals. Methods whose intervals hold 0 cannot be told from it by this reference.</p>\n{}",
        key(best->curve), escapeXml(best->setting), drawDifferences("Differences of errors", rows));
  }

  template <class Cost, class Best>
  void plot(const char* title, const char* label, Cost&& cost, Best&& best) {
    Plot plot{title, label, "mean relative error", {}, std::isfinite(r_.noiseFloor) ? r_.noiseFloor : 0};
    for (const std::string& name : r_.curves) plot.curves.push_back({name, {}});
    for (size_t i = 0; i < r_.points.size(); ++i) {
      const ChartPoint& p = r_.points[i];
      const std::string tip = fmt::format("{}, {}: {} in {} s, {}", r_.curves[p.curve], p.setting,
                                          percent(p.error.mean), shortNumber(p.run.cpu_s), megabytes(p.run.peakBytes));
      plot.curves[p.curve].points.push_back(
          {cost(p), p.error.mean, tip, fmt::format("#p{}", i), best(p), false, nameOf(p), p.error.confidence});
    }
    put("<section><h2>{}</h2>{}</section>\n", title, drawPlot(plot));
  }

  void table() {
    put("<h2>All points</h2><div class=\"scroll\"><table><tr><th>method</th><th class=\"text\">setting</th><th>mean "
        "error</th><th>&plusmn; 95 %</th>"
        "<th>99 % below</th><th>rms</th><th>bias</th><th>CPU s</th><th>wall "
        "s</th><th>memory</th><th>records</th></tr>\n");
    for (size_t i = 0; i < r_.points.size(); ++i) {
      const ChartPoint& p = r_.points[i];
      put("<tr class=\"{}\"><td>{}</td><td class=\"text\"><a "
          "href=\"#p{}\">{}</a></td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
          p.bestInTime ? "best" : "", key(p.curve), i, escapeXml(p.setting), percent(p.error.mean),
          percent(p.error.confidence), percent(p.error.p99), percent(p.error.rms), percent(p.error.bias));
      put("<td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", shortNumber(p.run.cpu_s), shortNumber(p.run.wall_s),
          megabytes(p.run.peakBytes), p.run.records);
    }
    put("</table></div>\n");
  }

  void cards() {
    put("<h2>Pictures</h2><p>Right: where the picture is too bright (red) and too dark (blue), full colour at "
        "{}.</p>\n{}<div class=\"cards\">\n",
        percent(r_.mapRange), pictureTools(r_.pictureWhite));
    put("<figure><img class=\"picture\" data-name=\"reference\" alt=\"reference\" "
        "src=\"{}\"><figcaption>reference<br><code>{}</code></figcaption></figure>\n",
        embedded(r_.referencePicture), escapeXml(r_.referenceCommandLine));
    for (size_t i = 0; i < r_.points.size(); ++i) {
      const ChartPoint& p = r_.points[i];
      put("<figure id=\"p{}\"><img class=\"picture\" data-name=\"{}, {}\" loading=\"lazy\" alt=\"picture\" src=\"{}\"> "
          "<img loading=\"lazy\" alt=\"error\" src=\"{}\">",
          i, escapeXml(r_.curves[p.curve]), escapeXml(p.setting), embedded(p.picture), embedded(p.errorMap));
      put("<figcaption>{} {}<br>{} in {} CPU s<br><code>{}</code></figcaption></figure>\n", key(p.curve),
          escapeXml(p.setting), percent(p.error.mean), shortNumber(p.run.cpu_s), escapeXml(p.commandLine));
    }
    put("</div>\n");
  }

  const ChartReport& r_;
};

}  // namespace

bool writeChartPage(const std::string& path, const ChartReport& report) {
  const std::string json = std::filesystem::path(path).filename().replace_extension(".json").string();
  std::string why;
  return writeFile(path, Page(report).write(json), why);
}

}  // namespace tomales
