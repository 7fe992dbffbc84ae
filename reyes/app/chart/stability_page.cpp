#include <fmt/format.h>

#include <filesystem>

#include "reyes/app/build_info.h"
#include "reyes/app/chart/html.h"
#include "reyes/app/chart/plot.h"
#include "reyes/app/chart/stability.h"
#include "reyes/app/settings.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

constexpr const char* kOwnStyle = R"(
.strip{display:grid;gap:4px;overflow-x:auto;font-size:12px;align-items:center;margin-top:10px}
.strip img{width:96px}.strip span{color:#555}
)";

class StabilityPage : Markup {
 public:
  std::string write(const std::vector<StabilityCurve>& curves, const std::string& commandLine,
                    const std::string& json) {
    openPage("Stability", "Where methods fail", kOwnStyle);
    put("<p>Each scene has a knob that makes it harder for the methods, until they fail. Error: mean of |test &minus; "
        "truth| / (truth + {}) over all colours of all pixels that the truth lights.</p>\n",
        ChartReference::kFloor);
    put("<p>Figures: <a href=\"{0}\">{0}</a>. Made with tomales {1}: <code>{2}</code></p>\n<ul>\n", escapeXml(json),
        kVersion, escapeXml(commandLine));
    for (size_t i = 0; i < curves.size(); ++i)
      put("<li><a href=\"#s{}\">{}</a></li>\n", i, escapeXml(curves[i].scene.title));
    put("</ul>\n{}", plotScripts());
    for (size_t i = 0; i < curves.size(); ++i) section(curves[i], i);
    closePage();
    return take();
  }

 private:
  static std::string name(size_t scene, const StabilityPoint& p) {
    return fmt::format("s{}m{}k{}", scene, p.method, p.knob);
  }

  void section(const StabilityCurve& c, size_t scene) {
    put("<h2 id=\"s{}\">{}</h2>\n<p>{}</p>\n", scene, escapeXml(c.scene.title), escapeXml(c.scene.note));
    for (const std::string& m : c.missing) put("<p><strong>Not measured:</strong> {}</p>\n", escapeXml(m));
    for (const StabilityPoint& p : c.points)
      if (p.error.notFinite > 0)
        put("<p><strong>{}, {} {}{}</strong>: in the picture they count as black, in the truth not at all; green in "
            "the error map.</p>\n",
            escapeXml(c.scene.methods[p.method].name), escapeXml(c.scene.knob), p.knob, notFiniteNote(p.error));
    Plot plot{c.scene.title, c.scene.knob, "mean relative error", {}, c.noiseFloor};
    if (c.scene.limit) {
      plot.limit = std::stod(c.scene.limit->value);
      plot.limitName = "limit: " + c.scene.limit->warning;
      put("<p>Limit: at {} {} and beyond the renderer warns (<code>{}</code>, red rings).</p>\n",
          escapeXml(c.scene.knob), c.scene.limit->value, escapeXml(c.scene.limit->warning));
    }
    for (const LabMethod& method : c.scene.methods) plot.curves.push_back({method.name, {}});
    for (const StabilityPoint& p : c.points)
      plot.curves[p.method].points.push_back(
          {std::stod(p.knob), p.error.mean,
           fmt::format("{}, {} {}: {} (99th percentile {})", c.scene.methods[p.method].name, c.scene.knob, p.knob,
                       percent(p.error.mean), percent(p.error.p99)),
           '#' + name(scene, p), false, p.warned});
    put("<div class=\"plots\">{}<div>\n", drawPlot(plot));
    table(c);
    put("</div></div>\n");
    pictures(c, scene);
  }

  void table(const StabilityCurve& c) {
    put("<div class=\"scroll\"><table><tr><th>{}</th>", escapeXml(c.scene.knob));
    for (const std::string& value : c.scene.values) put("<th>{}</th>", escapeXml(value));
    put("</tr>\n");
    for (size_t m = 0; m < c.scene.methods.size(); ++m) {
      put("<tr><td>{}</td>", escapeXml(c.scene.methods[m].name));
      for (const std::string& value : c.scene.values) {
        const StabilityPoint* p = find(c, m, value);
        put("<td>{}</td>", p ? percent(p->error.mean) : "&ndash;");
      }
      put("</tr>\n");
    }
    put("</table></div>\n");
  }

  static const StabilityPoint* find(const StabilityCurve& c, size_t method, const std::string& value) {
    for (const StabilityPoint& p : c.points)
      if (p.method == method && p.knob == value) return &p;
    return nullptr;
  }

  /// Shows the truths and, below them, error maps method by method.
  void pictures(const StabilityCurve& c, size_t scene) {
    put("<div class=\"strip\" style=\"grid-template-columns:8em repeat({},96px)\"><span>truth</span>",
        c.scene.values.size());
    for (const std::string& truth : c.truths)
      put("{}", truth.empty() ? "<span></span>" : fmt::format("<img alt=\"truth\" src=\"{}\">", embedded(truth)));
    for (size_t m = 0; m < c.scene.methods.size(); ++m) {
      put("\n<span>{}</span>", escapeXml(c.scene.methods[m].name));
      for (const std::string& value : c.scene.values) {
        if (const StabilityPoint* p = find(c, m, value))
          put("<img id=\"{}\" alt=\"error\" title=\"{}\" src=\"{}\">", name(scene, *p), escapeXml(p->commandLine),
              embedded(p->errorMap));
        else
          put("<span></span>");
      }
    }
    put("</div>\n");
  }
};

}  // namespace

bool writeStabilityPage(const std::string& path, const std::vector<StabilityCurve>& curves,
                        const std::string& commandLine) {
  const std::string json = std::filesystem::path(path).filename().replace_extension(".json").string();
  std::string why;
  return writeFile(path, StabilityPage().write(curves, commandLine, json), why);
}

}  // namespace tomales
