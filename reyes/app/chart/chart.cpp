#include "reyes/app/chart/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "reyes/app/chart/html.h"
#include "reyes/app/chart/report.h"
#include "reyes/app/chart/sweeps.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr int kPictureSize = 200;
constexpr double kReferenceShare = 1.0 / 3;  ///< Share of the budget for the reference,
constexpr double kBatchShare = 0.03;         ///< and for one batch of it.
constexpr int kFirstBatches = 4;  ///< Least number of batches of the reference that are rendered before the points.
constexpr double kQuiet = 0.25;  ///< A reference whose noise is this share of the least error needs no further batches.
constexpr double kSilent = 1e-4;  ///< Below this noise floor, further batches gain nothing.
constexpr int kTrialPaths = 64;

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Returns the requests of a prelude, and nothing for other arguments.
std::string preludeIn(const std::string& argument) {
  const std::string mark = kPrelude;
  return argument.starts_with(mark) ? argument.substr(mark.size()) : "";
}

/// Returns options without dashes and requests unchanged, without words that the name of the curve has.
std::string inShort(const Arguments& arguments) {
  std::string out;
  const auto add = [&](const std::string& piece) { out += (out.empty() ? "" : ", ") + piece; };
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (const std::string requests = preludeIn(arguments[i]); !requests.empty()) {
      add(requests);
      continue;
    }
    const bool hasValue =
        i + 1 < arguments.size() && !arguments[i + 1].starts_with("--") && preludeIn(arguments[i + 1]).empty();
    if (arguments[i] != "--gi" && arguments[i] != "--error-function")
      add(arguments[i].substr(2) + (hasValue ? ' ' + arguments[i + 1] : ""));
    i += hasValue;
  }
  return out;
}

/// Returns the number that the last argument ends with: 4 for 4x4, 300,000 for 300K.
double lastNumber(const Arguments& arguments) {
  const std::string& last = arguments.back();
  const std::string word = last.substr(last.rfind(' ') + 1);
  return std::atof(word.c_str()) * (word.ends_with('K') ? 1e3 : word.ends_with('M') ? 1e6 : 1);
}

LabSettings labOf(const ChartSettings& s, const ChartSweep& sweep) {
  return {s.folder.empty() ? chartCacheFolder() : s.folder, s.files, sweep.common + sharedArguments(s), s.budget_s};
}

class Chart {
 public:
  Chart(const ChartSettings& settings, const ChartSweep& sweep)
      : settings_(settings), sweep_(sweep), labSettings_(labOf(settings, sweep)), lab_(labSettings_) {
    report_.scene = fs::path(settings.files.front()).filename().string();
    report_.title = sweep.title;
    report_.oneKnob = sweep.oneKnob();
    report_.budget_s = settings.budget_s;
    report_.commandLine = joined(Arguments{"tomales", "chart"} + settings.files + Arguments{"--sweep", sweep.name} +
                                 sharedArguments(settings) +
                                 Arguments{"--budget", fmt::format("{:g}s", settings.budget_s), "-o", settings.output});
    for (const ChartCurve& curve : sweep.curves) report_.curves.push_back(curve.name);
  }

  /// Measures the reference for its share of the budget, then all points, then more batches while the budget lasts.
  /// Another run of the chart continues from there, and shows differences that a noisy reference hides now.
  int run() {
    if (const std::string problem = placesProblem(settings_.output, labSettings_.folder); !problem.empty())
      return fail(Severity::Output, problem);
    chooseReference();
    while ((reference_.batches() < kFirstBatches || lab_.secondsUsed() < kReferenceShare * settings_.budget_s) &&
           (reference_.batches() < 2 || reference_.noiseFloor() > kSilent) && addBatch()) {
    }
    if (reference_.batches() == 0)
      return fail(Severity::Error, "no reference: " + (badBatch_.empty() ? lab_.why() : badBatch_));
    if (reference_.isBlack())
      return fail(Severity::Error, "the reference is black, so there is no error to speak of; the sweep \"" +
                                       sweep_.name + "\" needs " + sweep_.needs);
    measure();
    while (!isQuiet() && addBatch()) {
    }
    judge();
    if (!write()) return fail(Severity::Output, "\"" + settings_.output + "\" could not be written");
    if (!report_.missing.empty())
      log_.report(Severity::Missing, "chart-missing", {},
                  fmt::format("{} of the points are missing; the page names them", report_.missing.size()));
    return exitCode();
  }

 private:
  int exitCode() const { return interruptExitCode() ? interruptExitCode() : exitCodeOf(log_); }
  int fail(Severity severity, const std::string& why) const {
    log_.report(severity, "chart", {}, why);
    return exitCode();
  }

  /// Returns the command for bash. Requests before the scene become a file of their own.
  std::string commandLine(const Arguments& arguments) const {
    std::string out = "tomales render";
    Arguments options;
    for (const std::string& a : arguments)
      if (const std::string requests = preludeIn(a); !requests.empty())
        out += " <(echo '" + requests + "')";
      else
        options.push_back(a);
    return out + ' ' + joined(settings_.files + labSettings_.arguments + options);
  }

  /// Renders the scene; a prelude becomes a file of its own before it.
  std::optional<Run> render(const Arguments& arguments) {
    Arguments out;
    for (const std::string& a : arguments) {
      const std::string text = preludeIn(a);
      if (text.empty()) {
        out.push_back(a);
        continue;
      }
      const std::string file =
          (fs::path(labSettings_.folder) / fmt::format("{:016x}.rib", std::hash<std::string>{}(text))).string();
      std::string why;
      writeFile(file, text + '\n', why);  // if this fails, the renderer says that the file is missing
      out.push_back(file);
    }
    return lab_.run(out);
  }

  /// Chooses as many paths as fit a small share of the budget.
  void chooseReference() {
    referenceArguments_ = sweep_.reference;
    if (!sweep_.tracedReference) return;
    const auto trial = render(sweep_.reference + Arguments{"--samples", std::to_string(kTrialPaths)});
    int paths = 16;
    if (trial)
      while (paths < 4096 && trial->wall_s * (2 * paths) / kTrialPaths < kBatchShare * settings_.budget_s) paths *= 2;
    referenceArguments_ = referenceArguments_ + Arguments{"--samples", std::to_string(paths)};
  }

  bool addBatch() {
    if (reference_.batches() >= settings_.batches || batchWall_s_ > lab_.secondsLeft()) return false;
    const auto run = render(referenceArguments_ + Arguments{sweep_.seed, std::to_string(reference_.batches() + 1)});
    if (!run) return false;
    report_.referenceSeconds += run->cpu_s;
    if (!run->recalled) batchWall_s_ = run->wall_s;
    takeWarnings(*run);
    const auto image = readImage(run->picture, badBatch_);
    if (!image) return false;
    if (!reference_.add(*image)) {
      badBatch_ = "\"" + run->picture + "\" differs in size from the batches before it";
      return false;
    }
    const double noise = reference_.noiseFloor();  // infinite with one batch
    log("reference", fmt::format("batch {}{}", reference_.batches(),
                                 std::isfinite(noise) ? fmt::format(", noise {:.3g} %", 100 * noise) : ""));
    return true;
  }

  bool isQuiet() const {
    double least = kInfinity;
    for (const ChartPoint& p : report_.points) least = std::min(least, p.error.mean);
    return reference_.noiseFloor() < std::max(kQuiet * least, kSilent);
  }

  /// Measures the cheapest setting of every method first, and among methods the one that was cheapest last time, so
  /// that a small budget leaves out as little as possible.
  void measure() {
    size_t steps = 0;
    for (const ChartCurve& curve : sweep_.curves) steps = std::max(steps, curve.settings.size());
    std::vector<double> last_s(sweep_.curves.size());
    std::vector<size_t> order(sweep_.curves.size());
    std::iota(order.begin(), order.end(), size_t{0});
    for (size_t step = 0; step < steps; ++step) {
      for (const size_t c : order)
        if (step < sweep_.curves[c].settings.size()) last_s[c] = measure(c, sweep_.curves[c].settings[step]);
      std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return last_s[a] < last_s[b]; });
    }
    std::stable_sort(report_.points.begin(), report_.points.end(),
                     [](const ChartPoint& a, const ChartPoint& b) { return a.curve < b.curve; });
  }

  /// Measures a setting. Returns CPU seconds; infinity if it could not be measured.
  double measure(size_t curve, const Arguments& arguments) {
    const auto run = render(arguments);
    std::string error;
    const auto image = run ? readImage(run->picture, error) : std::nullopt;
    if (!image) {
      report_.missing.push_back(report_.curves[curve] + ", " + inShort(arguments) + ": " + (run ? error : lab_.why()));
      return kInfinity;
    }
    takeWarnings(*run);
    ChartPoint point{curve,
                     inShort(arguments),
                     sweep_.oneKnob() ? lastNumber(arguments) : 0,
                     commandLine(arguments),
                     *run,
                     reference_.errorOf(*image),
                     false,
                     false,
                     {},
                     {}};
    log(report_.curves[curve], fmt::format("{}: {:.3g} % in {:.3g} CPU s{}{}", point.setting, 100 * point.error.mean,
                                           run->cpu_s, notFiniteNote(point.error), run->recalled ? " (recalled)" : ""));
    report_.points.push_back(std::move(point));
    return run->cpu_s;
  }

  void takeWarnings(const Run& run) { report_.warnings.insert(run.warnings.begin(), run.warnings.end()); }

  /// Computes the errors, once the reference is complete.
  void judge() {
    const float gain = 1 / (report_.pictureWhite = brightness(reference_.mean()));
    for (ChartPoint& p : report_.points) {
      std::string error;
      const auto image = readImage(p.run.picture, error);
      if (!image) continue;
      p.error = reference_.errorOf(*image);
      p.picture = p.run.picture + ".thumb.png";
      p.errorMap = p.run.picture + ".error.png";
      writeImage(p.picture, thumbnail(*image, kPictureSize, gain), true, log_);
      writeImage(p.errorMap, thumbnail(reference_.errorMap(*image, report_.mapRange), kPictureSize), true, log_);
    }
    report_.referencePicture = (fs::path(labSettings_.folder) / "reference.thumb.png").string();
    writeImage(report_.referencePicture, thumbnail(reference_.mean(), kPictureSize, gain), true, log_);
    report_.referenceBatches = reference_.batches();
    report_.noiseFloor = reference_.noiseFloor();
    report_.referenceCommandLine =
        commandLine(referenceArguments_ + Arguments{sweep_.seed, fmt::format("1..{}", reference_.batches())});
    markBest(report_);
  }

  bool write() const {
    return writeChartPage(settings_.output, report_) &&
           writeChartJson(fs::path(settings_.output).replace_extension(".json").string(), report_);
  }

  void log(const std::string& who, const std::string& what) const {
    fmt::print(stderr, "{:6.0f} s  {}, {}\n", lab_.secondsUsed(), who, what);
  }

  const ChartSettings& settings_;
  const ChartSweep& sweep_;
  const LabSettings labSettings_;
  Lab lab_;
  mutable Log log_;
  Arguments referenceArguments_;
  ChartReference reference_;
  std::string badBatch_;    ///< Why the last batch cannot be used; empty if it can, or was not rendered.
  double batchWall_s_ = 0;  ///< Time of the last batch that was rendered, by the clock.
  ChartReport report_;
};

}  // namespace

std::vector<std::string> sharedArguments(const ChartSettings& s) {
  Arguments out;
  if (s.format) out = out + Arguments{"--format", fmt::format("{}x{}", (*s.format)[0], (*s.format)[1])};
  if (s.bounces > 0) out = out + Arguments{"--bounces", std::to_string(s.bounces)};
  if (s.threads > 0) out = out + Arguments{"-t", std::to_string(s.threads)};
  if (s.trust.programs) out.push_back("--allow-system");
  if (s.trust.scenePlugins) out.push_back("--allow-plugins");
  if (!s.trust.pluginPath.empty()) out = out + Arguments{"--plugin-path", s.trust.pluginPath};
  if (!s.trust.shaderFolders.empty()) out = out + Arguments{"--shaders", s.trust.shaderFolders};
  return out;
}

std::string joined(const std::vector<std::string>& arguments) {
  std::string out;
  for (const std::string& a : arguments)
    out += (out.empty() ? "" : " ") + (a.find(' ') == std::string::npos ? a : '\'' + a + '\'');
  return out;
}

std::string chartCacheFolder() {
  const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
  const fs::path base = cache && *cache ? fs::path(cache)
                        : home && *home ? fs::path(home) / ".cache"
                                        : fs::temp_directory_path();
  return (base / "tomales" / "chart").string();
}

int chartCommand(const ChartSettings& settings) {
  const OrderlyEnd orderly;
  return Chart(settings, *chartSweep(settings.sweep)).run();
}

}  // namespace tomales
