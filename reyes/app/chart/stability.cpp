#include "reyes/app/chart/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "reyes/app/build_info.h"
#include "reyes/app/chart/html.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/settings.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr int kStabilitySize = 128;
constexpr float kMapRange = 0.3f;  ///< Relative error that has the full colour.

std::vector<std::string> scenesOf(const std::vector<std::string>& given) {
  std::vector<std::string> out;
  for (const std::string& name : given) {
    if (!fs::is_directory(name)) {
      out.push_back(name);
      continue;
    }
    const size_t first = out.size();
    for (const auto& entry : fs::directory_iterator(name))
      if (entry.path().extension() == ".rib") out.push_back(entry.path().string());
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
  }
  return out;
}

/// Replaces the first @ of each argument by a number.
Arguments numbered(Arguments arguments, int number) {
  for (std::string& a : arguments)
    if (const size_t at = a.find('@'); at != std::string::npos) a.replace(at, 1, std::to_string(number));
  return arguments;
}

Arguments withKnob(Arguments arguments, const std::string& value) {
  for (std::string& a : arguments) a = replaced(a, "$knob", value);
  return arguments;
}

/// Measures the curves of one command, within its budget of time.
class StabilityRun {
 public:
  StabilityRun(const ChartSettings& settings, Log& log)
      : settings_(settings), log_(log), start_(std::chrono::steady_clock::now()) {}

  StabilityCurve measure(LabScene scene) {
    StabilityCurve out{std::move(scene), {}, {}, 0, {}};
    for (const std::string& value : out.scene.values) measure(out, value);
    std::stable_sort(out.points.begin(), out.points.end(),
                     [](const StabilityPoint& a, const StabilityPoint& b) { return a.method < b.method; });
    return out;
  }

 private:
  double secondsLeft() const {
    return settings_.budget_s - std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  Arguments common(const LabScene& scene) const {
    Arguments out = scene.common;
    for (const std::string& a : sharedArguments(settings_)) out.push_back(a);
    return out;
  }

  void measure(StabilityCurve& out, const std::string& value) {
    const LabScene& scene = out.scene;
    out.truths.emplace_back();
    const uint64_t place =
        std::hash<std::string>{}(fs::weakly_canonical(scene.file).string());  // other scenes may have this name too
    const std::string stem =
        (fs::path(settings_.folder) /
         fmt::format("{}_{:08x}_{}", fs::path(scene.file).stem().string(), place & 0xffffffff, value))
            .string();
    const std::string rib = stem + ".rib", truthRib = stem + ".truth.rib", text = replaced(scene.text, "$knob", value);
    std::string why;
    if (!writeFile(rib, replaced(text, "$truth", "0"), why) ||
        !writeFile(truthRib, replaced(text, "$truth", "1"), why)) {
      out.missing.push_back(fmt::format("{} {}: \"{}\" cannot be written: {}", scene.knob, value, rib, why));
      return;
    }
    Lab truths({settings_.folder, {truthRib}, common(scene), secondsLeft()});
    ChartReference truth;
    std::string error;
    for (int batch = 1; batch <= settings_.batches; ++batch) {
      const auto run = truths.run(numbered(withKnob(scene.truth, value), batch));
      const auto image = run ? readImage(run->picture, error) : std::nullopt;
      if (!image || !truth.add(*image)) break;
    }
    if (truth.batches() < 2) {
      out.missing.push_back(fmt::format("{} {}: no truth: {}", scene.knob, value, truths.why()));
      return;
    }
    out.noiseFloor = std::max(out.noiseFloor, truth.noiseFloor());
    out.truths.back() = stem + ".truth.png";
    writeImage(out.truths.back(), thumbnail(truth.mean(), kStabilitySize), true, log_);
    Lab runs({settings_.folder, {rib}, common(scene), secondsLeft()});
    for (size_t m = 0; m < scene.methods.size(); ++m) measure(out, value, m, truth, runs, rib);
  }

  void measure(StabilityCurve& out, const std::string& value, size_t method, const ChartReference& truth, Lab& runs,
               const std::string& rib) {
    const LabMethod& m = out.scene.methods[method];
    const Arguments arguments = withKnob(m.arguments, value);
    const auto run = runs.run(arguments);
    std::string error;
    const auto image = run ? readImage(run->picture, error) : std::nullopt;
    if (!image) {
      out.missing.push_back(fmt::format("{}, {} {}: {}", m.name, out.scene.knob, value, run ? error : runs.why()));
      return;
    }
    Arguments command{"tomales", "render", rib};
    for (const Arguments& part : {common(out.scene), arguments})
      command.insert(command.end(), part.begin(), part.end());
    const auto& limit = out.scene.limit;
    const bool warned =
        limit && std::find(run->warnings.begin(), run->warnings.end(), limit->warning) != run->warnings.end();
    StabilityPoint point{method, value, truth.errorOf(*image), *run, joined(command), run->picture + ".error.png",
                         warned};
    writeImage(point.errorMap, thumbnail(truth.errorMap(*image, kMapRange), kStabilitySize), true, log_);
    fmt::print(stderr, "{}, {}, {} {}: {:.3g} %{}{}{}\n", fs::path(out.scene.file).stem().string(), m.name,
               out.scene.knob, value, 100 * point.error.mean, notFiniteNote(point.error), warned ? ", warned" : "",
               run->recalled ? " (recalled)" : "");
    out.points.push_back(std::move(point));
  }

  const ChartSettings& settings_;
  Log& log_;
  const std::chrono::steady_clock::time_point start_;
};

}  // namespace

int stabilityCommand(const ChartSettings& given) {
  const OrderlyEnd orderly;
  ChartSettings settings = given;
  if (settings.folder.empty()) settings.folder = chartCacheFolder();
  Log log;
  if (const std::string problem = placesProblem(settings.output, settings.folder); !problem.empty()) {
    log.report(Severity::Output, "chart", {}, problem);
    return exitCodeOf(log);
  }
  std::vector<StabilityCurve> curves;
  StabilityRun stability(settings, log);
  bool whole = true;
  for (const std::string& file : scenesOf(settings.files)) {
    std::string error;
    auto scene = readLabScene(file, error);
    if (!scene) {
      log.report(Severity::Error, "lab-scene", {std::make_shared<std::string>(file), 0},
                 "is no scene of a laboratory: " + error);
      return exitCodeOf(log);
    }
    curves.push_back(stability.measure(std::move(*scene)));
    whole = whole && curves.back().missing.empty();
  }
  Arguments command{"tomales", "chart", "--stability"};
  for (const Arguments& part : {settings.files, sharedArguments(settings), {"-o", settings.output}})
    command.insert(command.end(), part.begin(), part.end());
  if (!writeStabilityPage(settings.output, curves, joined(command)) ||
      !writeStabilityJson(fs::path(settings.output).replace_extension(".json").string(), curves, joined(command))) {
    log.report(Severity::Output, "chart", {}, "\"" + settings.output + "\" could not be written");
    return exitCodeOf(log);
  }
  if (!whole) log.report(Severity::Missing, "chart-missing", {}, "points are missing; the page names them");
  return interruptExitCode() ? interruptExitCode() : exitCodeOf(log);
}

bool writeStabilityJson(const std::string& path, const std::vector<StabilityCurve>& curves,
                        const std::string& commandLine) {
  using Json = nlohmann::ordered_json;
  Json out{{"version", kVersion}, {"command", commandLine}, {"scenes", Json::array()}};
  for (const StabilityCurve& c : curves) {
    Json scene{{"file", c.scene.file},        {"title", c.scene.title}, {"knob", c.scene.knob},
               {"noise_floor", c.noiseFloor}, {"missing", c.missing},   {"points", Json::array()}};
    if (c.scene.limit)
      scene["limit"] = {{"knob", std::stod(c.scene.limit->value)}, {"warning", c.scene.limit->warning}};
    for (const StabilityPoint& p : c.points)
      scene["points"].push_back({{"method", c.scene.methods[p.method].name},
                                 {"knob", std::stod(p.knob)},
                                 {"command", p.commandLine},
                                 {"cpu_s", p.run.cpu_s},
                                 {"warnings", p.run.warnings},
                                 {"mean_absolute_relative_error", p.error.mean},
                                 {"p99", p.error.p99},
                                 {"bias", p.error.bias},
                                 {"rms", p.error.rms},
                                 {"pixels_not_finite", p.error.notFinite}});
    out["scenes"].push_back(std::move(scene));
  }
  std::string why;
  return writeFile(path, out.dump(2, ' ', false, Json::error_handler_t::replace) + '\n', why);
}

}  // namespace tomales
