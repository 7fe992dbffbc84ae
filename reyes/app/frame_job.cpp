#include "reyes/app/frame_job.h"

#include <unistd.h>

#include <filesystem>

#include "reyes/app/interrupt.h"
#include "reyes/app/overrides.h"
#include "reyes/app/progress.h"
#include "reyes/frame.h"

namespace tomales {
namespace {

constexpr int kMostReferenceLightSamples = 256, kReferenceLightSamples = 64;

class FrameJob {
 public:
  FrameJob(const Scene& scene, const RenderSettings& settings, Stats& stats, Log& log)
      : scene_(scene),
        settings_(settings),
        stats_(stats),
        log_(log),
        mode_(giModeOf(settings.gi, scene)),
        camera_(scene.options),
        registry_(log),
        meter_(settings.progress) {
    registry_.addLibrary(tomales_builtin_shaders(), "built-in");
    shading_ = std::make_unique<ShadingSystem>(scene, registry_, nullptr, log, stats);
  }

  DeepFrame hide() {
    const StageTimer timer(stats_, "hide");
    return hideFrame(scene_, *shading_, control(0.0f, gathers() ? 0.3f : 0.5f), stats_, log_);
  }

  void prepareRays() {
    if (mode_ == GiMode::None && !shading_->needsRays()) return;
    const StageTimer timer(stats_, "raytrace");
    rays_ = std::make_unique<RayScene>(scene_, camera_, *shading_, settings_.hitList, stats_, log_);
    const GiSettings gi{mode_, settings_.samples, settings_.bounces, settings_.maxError, settings_.seed};
    services_ = std::make_unique<GiServices>(scene_, camera_, *rays_, *shading_, gi, stats_);
    shading_->setServices(services_.get());
  }

  void gather(const DeepFrame& frame) {
    if (!gathers() || interrupted()) return;
    const StageTimer timer(stats_, "gather");
    warnAboutBounces();
    services_->gatherPass(frame, meter_.stage(0.3f, 0.7f), &interrupted());
  }

  void shade(DeepFrame& frame) {
    const StageTimer timer(stats_, "shade");
    ShadeContext context;
    context.seed = settings_.seed;
    context.lightSamples = mode_ == GiMode::Reference ? referenceLightSamples() : 0;
    FrameControl shadeControl = control(gathers() ? 0.7f : 0.5f, 0.98f);
    if (interrupted()) {
      // What is hidden is worth its light; a second signal ends this too.
      log_.report(Severity::Warning, "interrupted", {},
                  "interrupted: finished buckets are shaded with direct light and written");
      context.indirect = false;
      shadeControl.cancelled = nullptr;
    }
    shadeFrame(frame, scene_, *shading_, context, shadeControl, stats_);
  }

  void write(const DeepFrame& frame) {
    const StageTimer timer(stats_, "image");
    writeFrame(frame, scene_, *shading_, control(0.98f, 1), log_);
    meter_.report(1);
  }

 private:
  bool gathers() const { return mode_ == GiMode::Gather; }

  void warnAboutBounces() const {
    for (const auto& light : scene_.lights) {
      const Param* bounces = findParam(light->shader.params, "bounces");
      const float asked = settings_.bounces > 0 ? static_cast<float>(settings_.bounces)
                          : bounces             ? bounces->number(0)
                                                : 1.0f;
      if (light->shader.name == "indirectlight" && asked > 1)
        log_.report(Severity::Warning, "gather-bounces", light->shader.where,
                    "light \"" + light->handle +
                        "\": gathering follows one bounce; more are followed by --gi reference");
    }
  }

  FrameControl control(float begin, float end) {
    return {meter_.stage(begin, end), &interrupted(), settings_.seed};
  }

  // The reference must not be noisier in direct light than in indirect.
  int referenceLightSamples() const {
    int samples = settings_.samples > 0 ? settings_.samples : kReferenceLightSamples;
    for (const auto& light : scene_.lights)
      if (const Param* p = findParam(light->shader.params, "samples"); p && light->area)
        samples = std::max(samples, static_cast<int>(std::min(
                                        p->number(0), static_cast<float>(kMostReferenceLightSamples))));
    return std::min(samples, kMostReferenceLightSamples);
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  Stats& stats_;
  Log& log_;
  const GiMode mode_;
  const Camera camera_;
  ShaderRegistry registry_;
  ProgressMeter meter_;
  std::unique_ptr<ShadingSystem> shading_;
  std::unique_ptr<RayScene> rays_;
  std::unique_ptr<GiServices> services_;
};

/// Hours of rendering must not end at a folder that never existed.
bool displaysHaveFolders(const Options& options, Log& log) {
  bool all = true;
  for (const DisplayCall& display : options.displays) {
    std::filesystem::path folder = std::filesystem::path(display.name).parent_path();
    if (folder.empty()) folder = ".";
    if (::access(folder.c_str(), W_OK | X_OK) == 0) continue;
    log.report(Severity::Output, "output-folder", display.where,
               "\"" + display.name +
                   "\" cannot be written: its folder is missing or closed to us; the frame was not rendered");
    all = false;
  }
  return all;
}

}  // namespace

void renderFrame(const Scene& scene, const RenderSettings& settings, Stats& stats, Log& log,
                 const std::function<void()>& afterStage) {
  if (!displaysHaveFolders(scene.options, log)) return;
  checkDisplays(scene.options, log);
  FrameJob job(scene, settings, stats, log);
  DeepFrame frame = job.hide();
  afterStage();
  job.prepareRays();
  job.gather(frame);
  afterStage();
  job.shade(frame);
  afterStage();
  job.write(frame);
}

}  // namespace tomales
