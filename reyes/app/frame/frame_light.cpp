#include "reyes/app/frame/frame_light.h"

#include <fmt/format.h>

#include <filesystem>

#include "reyes/app/frame/atlas_job.h"
#include "reyes/app/frame/limits.h"
#include "reyes/app/frame/provenance.h"
#include "reyes/app/frame/target.h"
#include "reyes/app/frame/time_budget.h"
#include "reyes/app/watch/preview.h"
#include "reyes/app/watch/sketch.h"
#include "reyes/base/stop.h"
#include "reyes/image_files.h"

namespace tomales {

void FrameLight::make(bool gathers) {
  const QualitySettings& quality = job_.settings().quality;
  const bool steers = quality.chooses() && !stopRequested() && isSteered();
  if (quality.isPilot && !steers) return;  // this pilot has nothing to choose
  if (steers && quality.targetError > 0) return reachTargetError(*this);
  if (steers)
    useTimeBudget(*this);
  else if (gathers)
    gather();
  if (!quality.audits() || stopRequested()) return;
  const AuditReport report = audit(lightSeedOf(job_.settings()));
  if (stopRequested()) return;
  tellAudit(report);
  if (quality.isHeld && quality.targetError > 0)
    tellMissed(report, quality, optionsOf(job_.quality()) + ", which hold for the animation", job_.log());
}

/// Tells whether rays and records decide the error of the light; if not, that is reported.
bool FrameLight::isSteered() const {
  const GiMethod& method = job_.method();
  if (method.mode == GiMode::None || method.caches || (method.isReference && !job_.counts())) return true;
  job_.log().report(
      Severity::Warning, "target-unused", {},
      fmt::format("--target-error and --time-budget choose rays and records, and the light of --gi {} comes from {}: "
                  "the picture is made as without them",
                  method.name, job_.counts() ? "photons" : "maps"));
  return false;
}

void FrameLight::gather() {
  gatherShown();
  endGather();
}

void FrameLight::gatherShown() {
  if (!needsGather() || stopRequested()) return;
  const StageTimer timer(job_.stats(), "gather");
  const bool afterMaps = job_.mode() == GiMode::Atlas || job_.mode() == GiMode::Radiosity;
  const auto progress = job_.meter().gathering(afterMaps);
  progress(0);
  std::function<void(int)> show;
  ShadeContext context = job_.shadeContext();
  context.purpose = Purpose::Sketch;
  if (Preview* preview = job_.preview(layout_))
    show = [&, preview](int stride) {
      preview->show(sketch(layout_, tiles_, stride, job_.scene(), job_.shading(), context, processStop()));
    };
  gatherRecords(progress, show);
  if (!stopRequested()) progress(1);
}

void FrameLight::endGather() {
  if (!needsGather()) return;
  GiServices& services = *job_.services();
  warnOfNoise(services.caches(), job_.log());
  if (!stopRequested()) services.tellBouncesLeft(job_.log());
  if (job_.rays()) warnOfThinWalls(*job_.rays(), job_.log());
  if (!job_.settings().stored.bakedFolder.empty() && job_.gathers() && !stopRequested())
    bakeGathered(services, layout_, tiles_, job_.scene(), job_.shading(), job_.settings(), job_.log());
}

void FrameLight::gatherRecords(const std::function<void(float)>& progress, const std::function<void(int)>& covered) {
  if (needsGather() && !stopRequested()) job_.services()->gatherPass(layout_, tiles_, progress, processStop(), covered);
}

AuditSettings FrameLight::auditSettings(uint32_t seed) const {
  AuditSettings settings;
  if (const int pixels = job_.settings().quality.audit; pixels > 0) settings.pixels = static_cast<size_t>(pixels);
  settings.seed = seed;
  settings.indirect = false;
  for (size_t g = 0; g < job_.scene().groups.size() && job_.mode() != GiMode::None; ++g)
    settings.indirect |= job_.shading().group(static_cast<int>(g)).indirectQuery() != nullptr;
  return settings;
}

AuditReport FrameLight::audit(uint32_t seed, const ErrorTarget& matters) {
  const StageTimer timer(job_.stats(), "audit");
  job_.meter().begin("auditing");
  AuditSettings settings = auditSettings(seed);
  settings.lobes = settings.indirect && !job_.method().isReference;  // the reference follows them in its pictures too
  settings.leastError = matters.error;
  settings.leastSmudges = matters.smudges;
  if (matters.smudges > 0 && job_.settings().quality.audit == 0) settings.smudgeSizes = 1;  // nothing asks for others
  return Audit(layout_, tiles_, job_.scene(), job_.shading(), settings, processStop()).of(job_.shadeContext());
}

void FrameLight::tellAudit(const AuditReport& report) {
  const std::string sentence = sentenceOf(report);
  job_.log().report(Severity::Note, "audit", {}, sentence);
  describeAudit(job_.scene().options, sentence, job_.settings());
  recordAudit(report, job_.stats());
}

void writeSketch(const FrameLight& light) {
  constexpr int kStride = 4;
  FrameJob& job = light.job();
  const Options& options = job.scene().options;
  const DisplayCall& first = options.displays.front();
  if (job.settings().quality.isPilot || first.type == "null" ||
      !driverOf(first, options, pluginTrust(job.settings())).empty())
    return;
  ShadeContext context = job.shadeContext();
  context.lightSamples = 1;
  context.indirect = false;
  context.purpose = Purpose::Sketch;
  const std::filesystem::path file(fileOf(first));
  job.setSketchFile((file.parent_path() / (file.stem().string() + ".sketch.exr")).string());
  writeImage(job.sketchFile(),
             sketch(light.layout(), light.tiles(), kStride, job.scene(), job.shading(), context, processStop()), false,
             job.log());
}

void checkRecords(const GiSettings& gathered, const std::string& file, const FrameJob& job, Log& log) {
  if (job.method().caches && gathered.mode == GiMode::None)
    log.report(
        Severity::Warning, "icf-without-light", {std::make_shared<std::string>(file), 0},
        "was gathered with --gi none: all indirect light is gathered while shading (with --gi none it is left out)");
}

}  // namespace tomales
