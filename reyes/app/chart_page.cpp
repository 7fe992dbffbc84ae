#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "reyes/app/chart_plot.h"
#include "reyes/app/chart_report.h"
#include "reyes/app/settings.h"

namespace tomales {
namespace {

constexpr double kAskedErrors[] = {0.08, 0.04, 0.02, 0.01, 0.005};

constexpr const char* kStyle = R"(
:root{font:16px/1.5 system-ui,sans-serif;color:#1b1b1b;background:#fff}
body{max-width:1200px;margin:0 auto;padding:0 16px 48px}
h1{font-size:1.5rem;margin:1.2em 0 .2em}h2{font-size:1.15rem;margin:2em 0 .5em}
p{max-width:46em;margin:.5em 0}code{font:12px/1.5 ui-monospace,monospace;overflow-wrap:anywhere}
a{color:#0058a3}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:14px}
th,td{padding:3px 10px 3px 0;text-align:right;white-space:nowrap;border-bottom:1px solid #e4e4e4}
th:first-child,td:first-child,td.text,th.text{text-align:left}
tr.best td:first-child{font-weight:600}
.plots{display:grid;grid-template-columns:1fr 1fr;gap:24px}.plots h2{margin-top:1em}
.key{display:inline-block;width:.8em;height:.8em;border-radius:50%;margin:0 .35em 0 0}
.legend{display:flex;flex-wrap:wrap;gap:4px 20px;margin:.6em 0;padding:0;list-style:none;font-size:14px}
svg{display:block;width:100%;height:auto;font:12px system-ui,sans-serif}
.grid{stroke:#ececec}.axis{stroke:#555;fill:none}.tick,.label{fill:#333}
.curve{fill:none;stroke-width:1.8}.point{stroke:#fff;stroke-width:1.2}.best{stroke:#111;stroke-width:2}
.front{fill:none;stroke:#ffd84d;stroke-width:9;stroke-linecap:round;stroke-linejoin:round;opacity:.55}
path.floor{stroke:#888;stroke-dasharray:3 4}text.floor{fill:#666}
a:hover circle,a:focus circle{r:7px}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(330px,1fr));gap:20px}
figure{margin:0;padding:10px;border:1px solid #e0e0e0;border-radius:6px}figure:target{outline:3px solid #ffd84d}
figure img{width:calc(50% - 3px);image-rendering:auto;vertical-align:top}
figcaption{font-size:13px}.narrow{display:none}
@media(max-width:800px){.plots{grid-template-columns:1fr}.wide{display:none}.narrow{display:block}.cards{grid-template-columns:1fr}}
)";

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0U);
    for (size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string embedded(const std::string& png) {
  std::ifstream file(png, std::ios::binary);
  return "data:image/png;base64," + base64({std::istreambuf_iterator<char>(file), {}});
}

std::string percent(double v) { return shortNumber(100 * v) + " %"; }
std::string megabytes(double bytes) { return fmt::format("{:.0f} MB", bytes / 1048576); }

class Page {
 public:
  explicit Page(const ChartReport& report) : r_(report) {}

  std::string write(const std::string& jsonName) {
    put("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    put("<title>{0}: error against cost</title><style>{1}</style></head><body>\n", escapeXml(r_.scene), kStyle);
    put("<h1>{}: {}</h1>\n", escapeXml(r_.scene), escapeXml(r_.title));
    summary(jsonName);
    reach();
    legend();
    put("<div class=\"plots\">\n");
    plot("Error against CPU time", "CPU seconds of the whole process", [](const ChartPoint& p) { return p.run.cpu_s; },
         [](const ChartPoint& p) { return p.bestInTime; });
    plot("Error against memory", "peak resident memory, MB", [](const ChartPoint& p) { return p.run.peakBytes / 1048576; },
         [](const ChartPoint& p) { return p.bestInMemory; });
    put("</div>\n");
    table();
    cards();
    put("</body></html>\n");
    return std::move(out_);
  }

 private:
  template <class... T>
  void put(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
  }
  std::string key(size_t curve) const { return fmt::format("<span class=\"key\" style=\"background:{}\"></span>{}", plotColor(curve), escapeXml(r_.curves[curve])); }

  void summary(const std::string& jsonName) {
    put("<p>Error: mean of |test &minus; reference| / (reference + {}) over all colours of all pixels that the reference lights. Yellow: the "
        "points that no other beats in both cost and error. Every point leads to its picture.</p>\n", ChartReference::kFloor);
    put("<p>The reference is the mean of {} independent pictures ({:.0f} CPU s) of <code>{}</code>; its own noise is {}.</p>\n", r_.referenceBatches,
        r_.referenceSeconds, escapeXml(r_.referenceCommandLine), std::isfinite(r_.noiseFloor) ? percent(r_.noiseFloor) : "unknown");
    put("<p>Figures: <a href=\"{0}\">{0}</a>. Made with tomales {1}: <code>{2}</code></p>\n", escapeXml(jsonName), kVersion, escapeXml(r_.commandLine));
    for (const std::string& m : r_.missing) put("<p><strong>Not measured:</strong> {}</p>\n", escapeXml(m));
  }

  void reach() {
    put("<h2>CPU seconds to reach an error</h2><div class=\"scroll\"><table><tr><th>method</th>");
    for (const double e : kAskedErrors) put("<th>{}</th>", percent(e));
    put("</tr>\n");
    for (size_t c = 0; c < r_.curves.size(); ++c) {
      put("<tr><td>{}</td>", key(c));
      for (const double e : kAskedErrors) {
        const auto seconds = secondsToReach(r_, c, e);
        put("<td>{}</td>", seconds ? shortNumber(*seconds) : "&ndash;");
      }
      put("</tr>\n");
    }
    put("</table></div>\n");
  }

  void legend() {
    put("<ul class=\"legend\">");
    for (size_t c = 0; c < r_.curves.size(); ++c) put("<li>{}</li>", key(c));
    put("</ul>\n");
  }

  template <class Cost, class Best>
  void plot(const char* title, const char* label, Cost&& cost, Best&& best) {
    Plot plot{title, label, "mean relative error", {}, std::isfinite(r_.noiseFloor) ? r_.noiseFloor : 0};
    for (const std::string& name : r_.curves) plot.curves.push_back({name, {}});
    for (size_t i = 0; i < r_.points.size(); ++i) {
      const ChartPoint& p = r_.points[i];
      const std::string tip = fmt::format("{}, {}: {} in {} s, {}", r_.curves[p.curve], p.setting, percent(p.error.mean), shortNumber(p.run.cpu_s),
                                          megabytes(p.run.peakBytes));
      plot.curves[p.curve].points.push_back({cost(p), p.error.mean, tip, fmt::format("#p{}", i), best(p)});
    }
    put("<section><h2>{}</h2><div class=\"wide\">{}</div><div class=\"narrow\">{}</div></section>\n", title, drawPlot(plot, 580, 420),
        drawPlot(plot, 358, 340));
  }

  void table() {
    put("<h2>All points</h2><div class=\"scroll\"><table><tr><th>method</th><th class=\"text\">setting</th><th>mean error</th><th>&plusmn; 95 %</th>"
        "<th>99th percentile</th><th>rms</th><th>bias</th><th>CPU s</th><th>wall s</th><th>memory</th><th>records</th></tr>\n");
    for (size_t i = 0; i < r_.points.size(); ++i) {
      const ChartPoint& p = r_.points[i];
      put("<tr class=\"{}\"><td>{}</td><td class=\"text\"><a href=\"#p{}\">{}</a></td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
          p.bestInTime ? "best" : "", key(p.curve), i, escapeXml(p.setting), percent(p.error.mean), percent(p.error.confidence), percent(p.error.p99),
          percent(p.error.rms), percent(p.error.bias));
      put("<td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", shortNumber(p.run.cpu_s), shortNumber(p.run.wall_s), megabytes(p.run.peakBytes),
          p.run.records);
    }
    put("</table></div>\n");
  }

  void cards() {
    put("<h2>Pictures</h2><p>Right: where the picture is too bright (red) and too dark (blue), full colour at {}.</p>\n<div class=\"cards\">\n",
        percent(r_.mapRange));
    put("<figure><img alt=\"reference\" src=\"{}\"><figcaption>reference<br><code>{}</code></figcaption></figure>\n", embedded(r_.referencePicture),
        escapeXml(r_.referenceCommandLine));
    for (size_t i = 0; i < r_.points.size(); ++i) {
      const ChartPoint& p = r_.points[i];
      put("<figure id=\"p{}\"><img loading=\"lazy\" alt=\"picture\" src=\"{}\"> <img loading=\"lazy\" alt=\"error\" src=\"{}\">", i, embedded(p.picture),
          embedded(p.errorMap));
      put("<figcaption>{} {}<br>{} in {} CPU s<br><code>{}</code></figcaption></figure>\n", key(p.curve), escapeXml(p.setting), percent(p.error.mean),
          shortNumber(p.run.cpu_s), escapeXml(p.commandLine));
    }
    put("</div>\n");
  }

  const ChartReport& r_;
  std::string out_;
};

}  // namespace

bool writeChartPage(const std::string& path, const ChartReport& report) {
  const std::string json = std::filesystem::path(path).filename().replace_extension(".json").string();
  std::ofstream file(path + ".part");
  file << Page(report).write(json);
  file.close();
  std::error_code problem;
  if (file) std::filesystem::rename(path + ".part", path, problem);
  return file && !problem;
}

}  // namespace tomales
