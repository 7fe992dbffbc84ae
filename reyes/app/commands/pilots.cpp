#include "reyes/app/commands/pilots.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "reyes/app/commands/make.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/frame/frame_shaders.h"
#include "reyes/app/frame/outputs.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/app/frame/render_frame.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/stop.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

bool isPilotFrame(const std::vector<int>& sorted, int frame) {
  return std::binary_search(sorted.begin(), sorted.end(), frame);
}

class PilotRun {
 public:
  PilotRun(const RenderSettings& settings, Log& log) : settings_(settings), log_(log) {}

  std::optional<HeldQuality> run() {
    held_.pilots = settings_.quality.pilotFrames ? *settings_.quality.pilotFrames : pilotsOf(frames());
    if (held_.pilots.empty() ||
        (held_.pilots.size() == 1 && settings_.quality.animationSettings.empty() && !settings_.quality.pilotFrames))
      return std::nullopt;
    read([this](Scene&& scene) { take(scene); }, true);
    if (stopRequested()) return std::nullopt;
    // A file that records that nothing was chosen keeps other runs from trying again.
    if (held_.worlds.empty()) return settings_.quality.animationSettings.empty() ? std::nullopt : std::optional(held_);
    std::vector<std::string> chosen;
    for (const LightQuality& q : held_.worlds) chosen.push_back(optionsOf(q));
    log_.report(Severity::Note, "animation-settings", {},
                fmt::format("found on {} {}; all frames have: {}", held_.pilots.size() > 1 ? "frames" : "frame",
                            fmt::join(held_.pilots, ", "), fmt::join(chosen, "; in the next world: ")));
    return held_;
  }

 private:
  void read(const std::function<void(Scene&&)>& onScene, bool makes) {
    RibSettings rib;
    rib.trust = settings_.input.trust;
    if (!settings_.picture.outputRoot.empty()) rib.archivePath.push_back(settings_.picture.outputRoot);
    rib.onScene = onScene;
    // A pilot may read files that earlier Make requests have made.
    if (makes) rib.onMake = [this](const Request& request) { make(request); };
    Log quiet(Log::Verbosity::Quiet);  // faults of the scene are reported when it is rendered
    readRib(settings_.input.files, rib, quiet);
  }

  void make(const Request& request) {
    const int place = makes_++;
    if (!settings_.input.makes || std::ranges::binary_search(*settings_.input.makes, place))
      performMake(request, settings_.picture.outputRoot, log_);
  }

  /// Returns the numbers of the frames to be rendered.
  std::vector<int> frames() {
    if (settings_.input.frames) return *settings_.input.frames;
    std::vector<int> out;
    read([&](Scene&& scene) { out.push_back(scene.options.frame); }, false);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  void take(Scene& scene) {
    const int frame = scene.options.frame;
    ++world_;
    if (!isPilotFrame(held_.pilots, frame)) return;
    RenderSettings settings = settings_;
    settings.picture.skipFinished = settings.picture.resume = settings.report.progress = false;
    settings.report.preview.clear();
    settings.stored.bakedFolder.clear();
    settings.report.pixels.clear();
    applyOverrides(scene, settings);
    Log quiet(Log::Verbosity::Quiet);  // it is reported when the frame is rendered
    nameOutputs(scene.options, settings, quiet);
    const auto shaders = frameShaders(settings, quiet);
    Stats stats;
    if (writesMapsAlone(scene.options, settings))
      return renderFrame(scene, *shaders, world_, settings, stats, quiet, [] {});
    if (frame != frame_) picture_ = 0;
    frame_ = frame;
    settings.quality.isPilot = true;
    settings.quality.onQuality = [&](const LightQuality& q) { mergeQuality(held_, picture_, q, settings_.quality); };
    try {
      renderFrame(scene, *shaders, world_, settings, stats, log_, [] {});
    } catch (const std::exception& e) {
      log_.report(Severity::Warning, "pilot-failed", scene.where,
                  fmt::format("{}; settings of light are found without frame {}", e.what(), frame));
    }
    ++picture_;
  }

  const RenderSettings& settings_;
  Log& log_;
  HeldQuality held_;
  int world_ = -1, frame_ = -1, makes_ = 0;
  size_t picture_ = 0;
};

}  // namespace

bool holdsForAnimation(const RenderSettings& s) {
  return s.quality.chooses() && (!s.input.frames || s.input.frames->size() > 1 || s.quality.pilotFrames ||
                                 !s.quality.animationSettings.empty());
}

std::optional<HeldQuality> findHeldQuality(const RenderSettings& settings, Log& log) {
  const std::string& file = settings.quality.animationSettings;
  if (!file.empty() && fs::exists(file)) {
    std::string error;
    auto held = readHeldQuality(file, settings.quality, error);
    if (!held)
      log.report(Severity::Error, "animation-settings", {std::make_shared<std::string>(file), 0},
                 "cannot be used: " + error);
    return held;
  }
  if (std::find(settings.input.files.begin(), settings.input.files.end(), "-") != settings.input.files.end())
    return std::nullopt;
  auto held = PilotRun(settings, log).run();
  if (!held || file.empty()) return held;
  try {
    writeHeldQuality(file, *held, settings.quality);
  } catch (const WriteError& e) {
    log.report(Severity::Output, "animation-settings", {std::make_shared<std::string>(file), 0}, e.what());
  }
  return held;
}

}  // namespace tomales
