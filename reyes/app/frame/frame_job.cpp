#include "reyes/app/frame/frame_job.h"

#include <fmt/format.h>

#include "raytrace/visible_displacement.h"
#include "reyes/app/frame/atlas_job.h"
#include "reyes/app/frame/light_sources.h"
#include "reyes/app/frame/limits.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/app/frame/provenance.h"
#include "reyes/app/frame/shaded_motion.h"
#include "reyes/app/frame/sky_portals.h"
#include "reyes/app/frame/target.h"
#include "reyes/app/frame/time_budget.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/app/watch/preview.h"
#include "reyes/app/watch/sketch.h"
#include "reyes/area_lights.h"
#include "reyes/base/search_path.h"
#include "reyes/moving_surfaces.h"

namespace tomales {
namespace {

constexpr int kMostReferenceLightSamples = 256, kReferenceLightSamples = 64;

}  // namespace

FrameJob::FrameJob(Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings, Stats& stats, Log& log)
    : scene_(scene),
      settings_(settings),
      stats_(stats),
      log_(log),
      quality_{settings.light.samples, settings.light.maxError, settings.light.lightSamples},
      camera_(scene.options),
      meter_(settings.report.progress, "preparing", settings.report.watcher),
      clouds_(pathOf(scene.options.searchPaths, "texture"), settings.picture.outputRoot) {
  measureAreaLights(scene, shaders, log);
  if (!settings.picture.draft) displaceByMovingSurfaces(scene, shaders, log);
  shading_ = std::make_unique<ShadingSystem>(scene, shaders, nullptr, log, stats);
  shading_->setClouds(&clouds_);
  method_ = &methodOf(settings, *shading_);
  if (traces())
    open([](const Attributes& a) {
      const Visibility& v = a.visibility;
      return v.diffuse || v.specular || v.transmission || v.photon;
    });
  gathers_ = method_->caches;
  counts_ = countsPhotons(*method_, scene);
  for (size_t g = 0; g < scene.groups.size() && mode() == GiMode::None && keepsHemispheres(giSettings()); ++g)
    gathers_ |= shading_->asksHemispheres(static_cast<int>(g));
  warnAboutPixels();
}

void FrameJob::warnAboutPixels() const {
  if (settings_.report.pixels.empty()) return;
  const PixelRect inside = layOutFrame(scene_).padded;
  std::string outside;
  for (const auto& [x, y] : settings_.report.pixels)
    if (!inside.contains(x, y)) outside += fmt::format("{}{},{}", outside.empty() ? "" : " and ", x, y);
  if (!outside.empty())
    log_.report(Severity::Warning, "pixel-outside", {},
                fmt::format("--pixel: {} lies outside of the picture: nothing can be told of it", outside));
}

FrameJob::~FrameJob() = default;

void FrameJob::open(const std::function<bool(const Attributes&)>& wanted) {
  meter_.begin("opening procedurals");
  scene_.open(wanted);
  shading_->bindNewGroups();
}

void FrameJob::openAll() {
  open([](const Attributes&) { return true; });
}

bool FrameJob::hide(const DeepFrame& layout, const TileSink& sink) {
  const StageTimer timer(stats_, "hide");
  return hideTiles(layout, scene_, *shading_, control("hiding", 0, gathers() ? hidden_ : gathered_), stats_, log_,
                   sink);
}

void FrameJob::checkRecords(const GiSettings& gathered, const std::string& file) const {
  if (method_->caches && gathered.mode == GiMode::None)
    log_.report(
        Severity::Warning, "icf-without-light", {std::make_shared<std::string>(file), 0},
        "was gathered with --gi none: all indirect light is gathered while shading (with --gi none it is left out)");
}

void FrameJob::prepareRays() {
  if (!traces()) return;
  const StageTimer timer(stats_, "raytrace");
  meter_.begin("ray geometry");
  chooseDisplacements(scene_, camera_, *shading_, log_);
  rays_ = std::make_unique<RayScene>(scene_, camera_, *shading_, raySettings(settings_, scene_.options), stats_, log_);
  findSkyPortals(scene_, camera_, *shading_, *rays_, log_);
  warnOfShadedMotion(*rays_, camera_, *shading_, log_);
  prepareRays([tools = RayTools{rays_.get(), shading_.get()}] { return &tools; });
}

void FrameJob::findOpenings() {
  if (!wantsSkyPortals(scene_, *shading_)) return;
  const StageTimer timer(stats_, "raytrace");
  // Whoever shades the shot chooses displacements again.
  std::vector<std::shared_ptr<const Attributes>> ofGroups, ofObjects;
  for (const ShadeGroup& g : scene_.groups) ofGroups.push_back(g.attributes);
  for (const Object& o : scene_.objects) ofObjects.push_back(o.attributes);
  Log unheard(Log::Verbosity::Quiet);
  chooseDisplacements(scene_, camera_, *shading_, unheard);
  {
    Stats ofSearch;
    const RayScene rays(scene_, camera_, *shading_, raySettings(settings_, scene_.options), ofSearch, unheard);
    findSkyPortals(scene_, camera_, *shading_, rays, log_);
  }
  for (size_t g = 0; g < ofGroups.size(); ++g) scene_.groups[g].attributes = ofGroups[g];
  for (size_t o = 0; o < ofObjects.size(); ++o) scene_.objects[o].attributes = ofObjects[o];
}

void FrameJob::prepareRays(RaySource rays) {
  raySource_ = std::move(rays);
  services_ = std::make_unique<GiServices>(scene_, camera_, raySource_, *shading_, giSettings(), stats_);
  services_->keepWork(kept_);
  shading_->setServices(services_.get());
  setLightSources(*services_, *method_,
                  {raySource_, scene_, *shading_, camera_, settings_, lightProgress(), kept_, stats_, log_});
}

GiSettings FrameJob::giSettings() const {
  return {mode(),
          quality_.samples,
          settings_.light.bounces,
          quality_.maxError,
          lightSeedOf(settings_),
          settings_.light.errorFunction,
          mode() != GiMode::Atlas || storesDirect(settings_, *shading_)};
}

void FrameJob::light(const DeepFrame& layout, const TileReader& tiles, bool gathers) {
  const bool steers = settings_.quality.chooses() && !interrupted() && steersLight();
  if (settings_.quality.isPilot && !steers) return;  // this pilot has nothing to choose
  if (steers && settings_.quality.targetError > 0)
    return reachTargetError(*this, layout, tiles, settings_, stats_, log_);
  if (steers)
    useTimeBudget(*this, layout, tiles, settings_, stats_, log_);
  else if (gathers)
    gather(layout, tiles);
  if (!settings_.quality.audits() || interrupted()) return;
  const AuditReport report = audit(layout, tiles, lightSeedOf(settings_));
  if (interrupted()) return;
  tellAudit(report);
  if (settings_.quality.isHeld && settings_.quality.targetError > 0)
    tellMissed(report, settings_.quality, optionsOf(quality_) + ", which hold for the shot", log_);
}

/// Tells whether rays and records decide the error of the light; says so if not.
bool FrameJob::steersLight() const {
  const bool steers = mode() == GiMode::None || method_->caches || (method_->isReference && !counts_);
  if (!steers)
    log_.report(
        Severity::Warning, "target-unused", {},
        fmt::format(
            "--target-error and --time-budget choose rays and records, and the light of --gi {} comes from {}: the "
            "picture is made as without them",
            method_->name, counts_ ? "photons" : "maps"));
  return steers;
}

double FrameJob::elapsed_s() const {
  return settings_.quality.reading_s + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void FrameJob::setQuality(const LightQuality& quality) {
  quality_ = quality;
  if (services_) services_->startAgain(giSettings());
}

void FrameJob::gather(const DeepFrame& layout, const TileReader& tiles) {
  gatherShown(layout, tiles);
  endGather(layout, tiles);
}

void FrameJob::gatherShown(const DeepFrame& layout, const TileReader& tiles) {
  if (!(gathers() || counts_) || interrupted()) return;
  const StageTimer timer(stats_, "gather");
  const auto progress = meter_.pass("gathering", makesLight() ? lightMade() : hidden_, gathered_);
  progress(0);
  openPreview(layout);
  std::function<void(int)> show;
  ShadeContext context = shadeContext();
  context.sketch = true;
  if (preview_)
    show = [&](int stride) {
      preview_->show(sketch(layout, tiles, stride, scene_, *shading_, context, interrupted()));
    };
  gatherRecords(layout, tiles, progress, show);
  if (!interrupted()) progress(1);
}

void FrameJob::endGather(const DeepFrame& layout, const TileReader& tiles) {
  if (!(gathers() || counts_)) return;
  warnOfNoise(services_->caches(), log_);
  if (!interrupted()) services_->tellBouncesLeft(log_);
  if (rays_) warnOfThinWalls(*rays_, log_);
  if (!settings_.stored.bakedFolder.empty() && gathers() && !interrupted())
    bakeGathered(*services_, layout, tiles, scene_, *shading_, settings_, log_);
}

void FrameJob::gatherRecords(const DeepFrame& layout, const TileReader& tiles,
                             const std::function<void(float)>& progress, const std::function<void(int)>& covered) {
  if ((gathers() || counts_) && !interrupted()) services_->gatherPass(layout, tiles, progress, &interrupted(), covered);
}

AuditPlan FrameJob::auditPlan(uint32_t seed) const {
  AuditPlan plan;
  if (settings_.quality.audit > 0) plan.pixels = static_cast<size_t>(settings_.quality.audit);
  plan.seed = seed;
  plan.indirect = false;
  for (size_t g = 0; g < scene_.groups.size() && mode() != GiMode::None; ++g)
    plan.indirect |= shading_->indirectQuery(static_cast<int>(g)) != nullptr;
  return plan;
}

AuditReport FrameJob::audit(const DeepFrame& layout, const TileReader& tiles, uint32_t seed) {
  const StageTimer timer(stats_, "audit");
  meter_.begin("auditing");
  return Audit(layout, tiles, scene_, *shading_, auditPlan(seed), interrupted()).of(shadeContext());
}

void FrameJob::tellAudit(const AuditReport& report) {
  const std::string sentence = sentenceOf(report);
  log_.report(Severity::Note, "audit", {}, sentence);
  describeAudit(scene_.options, sentence, settings_);
  recordAudit(report, stats_);
}

ShadeContext FrameJob::shadeContext() const {
  ShadeContext context;
  context.seed = lightSeedOf(settings_);
  context.direct = settings_.light.direct;
  context.lightSamples = quality_.lightSamples > 0 ? quality_.lightSamples
                         : method_->isReference    ? referenceLightSamples()
                                                   : 0;
  return context;
}

FrameControl FrameJob::control(const char* pass, float begin, float end) {
  return {meter_.pass(pass, begin, end), &interrupted(), settings_.picture.seed};
}

// The reference must not be noisier in direct light than in indirect.
int FrameJob::referenceLightSamples() const {
  const int samples = quality_.samples > 0 ? quality_.samples : kReferenceLightSamples;
  return std::min(std::max(samples, shading_->mostAreaSamples()), kMostReferenceLightSamples);
}

}  // namespace tomales
