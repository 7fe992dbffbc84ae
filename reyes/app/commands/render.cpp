#include "reyes/app/commands/render.h"
#include "reyes/app/exit_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>

#include "reyes/app/commands/foreign_file.h"
#include "reyes/app/commands/make.h"
#include "reyes/app/commands/pilots.h"
#include "reyes/app/frame/empty_frame.h"
#include "reyes/app/frame/frame_shaders.h"
#include "reyes/app/frame/granted.h"
#include "reyes/app/frame/hide.h"
#include "reyes/app/frame/limits.h"
#include "reyes/app/frame/outputs.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/app/frame/provenance.h"
#include "reyes/app/frame/render_frame.h"
#include "reyes/app/frame/shared_light.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/app/watch/progress.h"
#include "reyes/app/watch/run_report.h"
#include "reyes/base/parallel.h"
#include "reyes/base/stop.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image.h"
#include "reyes/image_files.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

/// Finds the pictures that Make requests read. They matter only where the command line may rename them or change their
/// size.
RenderSettings withSources(RenderSettings settings) {
  if (namesPicture(settings.picture.output) || settings.picture.format || settings.picture.crop)
    settings.input.sources = makeSources(settings.input.files);
  return settings;
}

class RenderRun {
 public:
  /// A job takes a frame and the number of its scene in the stream.
  using Job = std::function<void(Scene&, ShaderRegistry&, int world, const RenderSettings&, Stats&, Log&,
                                 const std::function<void()>& afterStage)>;

  /// `seen`: the job makes what is visible of a frame, so a frame in which nothing is visible is reported.
  RenderRun(const RenderSettings& settings, Job job, bool seen = true)
      : log_(settings.report.verbosity),
        report_(settings, log_),
        settings_(withSources(asGranted(settings, log_))),
        job_(std::move(job)),
        seen_(seen),
        threads_(settings_.resources.threads) {}

  int run() {
    RibSettings rib;
    if (holdsForAnimation(settings_)) {
      held_ = findHeldQuality(settings_, log_);
      if (!held_ && log_.worst() >= Severity::Error) return exitCodeOf(log_);
      report_.skip();
    }
    rib.trust = settings_.input.trust;
    if (!settings_.picture.outputRoot.empty()) rib.archivePath.push_back(settings_.picture.outputRoot);
    rib.onScene = [this](Scene&& scene) { takeScene(std::move(scene)); };
    if (settings_.input.framesApart && settings_.input.frames)
      rib.skipsFrame = [this](int frame) { return !wants(frame); };
    rib.onSkipped = [this](int worlds) { scenes_ += worlds; };
    rib.onMake = [this](const Request& request) {
      const auto& makes = settings_.input.makes;
      if (const int place = makes_++; makes && !std::binary_search(makes->begin(), makes->end(), place)) return;
      made_ = true;
      performMake(request, settings_.picture.outputRoot, log_);
    };
    beginReading();
    const bool read = readAll(rib);
    endReading();
    if (read && scenes_ == 0 && !made_ && !stopRequested())
      log_.report(Severity::Error, "no-world", {std::make_shared<std::string>(settings_.input.files.front()), 0},
                  "nothing to render: no WorldBegin ... WorldEnd was found");
    if (scenes_ > 0 && rendered_ == 0 && settings_.input.frames && !settings_.input.frames->empty() && !stopRequested())
      log_.report(Severity::Error, "no-frame", {std::make_shared<std::string>(settings_.input.files.front()), 0},
                  "none of the frames that --frames names is in the scene");
    if (rendered_ > 0 && namesPicture(settings_.picture.output) && !outputUsed_)
      log_.report(Severity::Output, "output-unused", {std::make_shared<std::string>(settings_.picture.output), 0},
                  "not written: -o replaces a picture, and the Displays of the scene are all maps");
    report_.finish();
    if (const int code = interruptExitCode()) return code;
    const ExitCode code = exitCodeOf(log_, settings_.report.strict);
    return read ? code : std::max(code, kUnreadable);
  }

 private:
  /// Reads the frames. It stops after an interrupted one.
  bool readAll(const RibSettings& rib) {
    if (isAnyForeign(settings_.input.files, log_)) return false;
    try {
      return readRib(settings_.input.files, rib, log_);
    } catch (const Stopped&) {
      return true;
    }
  }

  void takeScene(Scene&& scene) {
    endReading();
    ++scenes_;
    if (wants(scene.options.frame)) {
      const OrderlyEnd orderly;
      ++rendered_;
      applyOverrides(scene, settings_);
      nameOutputs(scene.options, settings_, log_);
      const std::unique_ptr<ShaderRegistry> shaders = frameShaders(settings_, log_);
      const std::string contents = contentsOf(scene, *shaders, settings_);
      if (settings_.picture.skipFinished && isFinished(scene.options, contents, settings_, log_)) return skip(scene);
      describeOutputs(scene.options, contents, settings_);
      warnAboutOverwriting(scene);
      warnOfFloatRange(scene, log_);
      if (!settings_.picture.draft) warnOfCoarseDicing(scene, log_);
      report_.begin(scene.options.frame);
      Stats& stats = report_.stats();
      const int64_t seenBefore = stats.geometry.micropolygonsVisible;
      const int errorsBefore = errors();
      try {
        const RenderSettings settings = held(scene);
        job_(scene, *shaders, scenes_ - 1, settings, stats, log_, [this] { report_.flush(); });
      } catch (const std::exception& e) {  // later frames may fit, and finished ones keep their statistics
        log_.report(severityOf(e), "frame-failed", scene.where, messageOf(e) + "; the frame was not finished");
      }
      if (seen_ && stats.geometry.micropolygonsVisible == seenBefore && !settings_.picture.resume && !stopRequested() &&
          errors() == errorsBefore)  // else the file may have been refused
        explainEmptyFrame(scene, log_);
      report_.end(scene.where);
      throwIfStopped();
    } else {
      report_.skip();
    }
    beginReading();
  }

  /// Returns the settings of a frame, with those of light that hold for the animation.
  RenderSettings held(Scene& scene) {
    RenderSettings out = settings_;
    out.quality.reading_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - readingSince_).count();
    if (!settings_.quality.chooses() || writesMapsAlone(scene.options, settings_)) return out;
    const int frame = scene.options.frame;
    if (frame != pictureFrame_) picture_ = 0;
    pictureFrame_ = frame;
    const size_t world = picture_++;
    if (held_ && world < held_->worlds.size()) {
      hold(held_->worlds[world], out);
      describeQuality(scene.options, optionsOf(held_->worlds[world]), out);
      out.quality.auditsHeld =
          out.quality.targetError > 0 && out.quality.auditEvery > 0 && frame % out.quality.auditEvery == 0;
    } else if (holdsForAnimation(settings_)) {  // of a stream that cannot be read twice, the first frame decides
      out.quality.onQuality = [this, world](const LightQuality& q) {
        if (!held_) held_.emplace();
        mergeQuality(*held_, world, q, settings_.quality);
      };
    }
    return out;
  }

  void skip(const Scene& scene) {
    log_.report(Severity::Note, "frame-skipped", scene.where,
                fmt::format("frame {} is finished: its pictures hold what would be rendered", scene.options.frame));
    for (const DisplayCall& display : scene.options.displays)
      outputUsed_ |= display.name == withFrameNumber(settings_.picture.output, scene.options.frame);
    report_.skip();
    beginReading();
  }

  void beginReading() {
    readingSince_ = std::chrono::steady_clock::now();
    parse_.emplace(report_.stats(), "parse");
    meter_.emplace(settings_.report.progress, "reading");
  }
  void endReading() {
    parse_.reset();
    meter_.reset();
  }

  bool wants(int frame) const {
    return !settings_.input.frames ||
           std::binary_search(settings_.input.frames->begin(), settings_.input.frames->end(), frame);
  }

  int errors() const {
    int out = 0;
    for (const LogEntry& e : log_.entries()) out += e.severity >= Severity::Error ? e.count : 0;
    return out;
  }

  void warnAboutOverwriting(const Scene& scene) {
    const std::string output = withFrameNumber(settings_.picture.output, scene.options.frame);
    if (!output.empty() && !namesPicture(output)) return warnAboutOverwriting(placeOf(output), output, scene.where);
    for (const DisplayCall& display : scene.options.displays) {
      outputUsed_ |= display.name == output;
      if (display.type != "null")
        warnAboutOverwriting(placeOf(display, scene.options, pluginTrust(settings_)), display.name, display.where);
    }
  }

  void warnAboutOverwriting(const std::string& place, const std::string& file, const SourceLoc& where) {
    if (written_.insert(place).second) return;
    log_.report(
        Severity::Warning, "output-overwritten", where,
        "\"" + file + "\" of an earlier frame is written over; with -o, # in the name stands for the frame number");
  }

  Log log_;
  RunReport report_;
  const RenderSettings settings_;
  const Job job_;
  const bool seen_;
  const ThreadLimit threads_;
  std::optional<StageTimer> parse_;  // Runs while the scene is read.
  std::chrono::steady_clock::time_point readingSince_;
  std::optional<ProgressMeter> meter_;  // Runs while the scene is read.
  std::set<std::string> written_;       ///< Places of files.
  std::optional<HeldQuality> held_;
  int pictureFrame_ = 0;  // Frame of the last picture.
  size_t picture_ = 0;    // Number of the next picture in that frame.
  int scenes_ = 0, rendered_ = 0, makes_ = 0;
  bool made_ = false;  // True if a Make request was performed.
  bool outputUsed_ = false;
};

}  // namespace

int renderCommand(const RenderSettings& settings) { return RenderRun(settings, renderFrame).run(); }

int hideCommand(const RenderSettings& settings) {
  const auto job = [](Scene& scene, ShaderRegistry& shaders, int world, const RenderSettings& s, Stats& stats, Log& log,
                      const std::function<void()>&) { hideToFile(scene, shaders, world, s, stats, log); };
  return RenderRun(settings, job).run();
}

int prepareCommand(const RenderSettings& settings, const PrepareCommand& command) {
  const auto job = [&](Scene& scene, ShaderRegistry& shaders, int, const RenderSettings& s, Stats& stats, Log& log,
                       const std::function<void()>&) {
    makeSharedLight(scene, shaders, s, command.pass, command.part, stats, log);
  };
  return RenderRun(settings, job, false).run();
}

}  // namespace tomales
