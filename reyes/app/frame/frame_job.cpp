#include "reyes/app/frame/frame_job.h"

#include <fmt/format.h>

#include "raytrace/visible_displacement.h"
#include "reyes/app/frame/atlas_job.h"
#include "reyes/app/frame/light_sources.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/app/frame/shaded_motion.h"
#include "reyes/app/frame/sky_portals.h"
#include "reyes/app/watch/preview.h"
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
      meter_(settings.report.progress, settings.report.watcher),
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
    gathers_ |= shading_->group(static_cast<int>(g)).asksHemispheres();
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
                fmt::format("--pixel: {} lies outside of the picture: nothing can be printed for it", outside));
}

FrameJob::~FrameJob() = default;

void FrameJob::open(const std::function<bool(const Attributes&)>& wanted) {
  meter_.begin("opening procedurals");
  scene_.expandAll(wanted);
  shading_->bindNewGroups();
}

void FrameJob::openAll() {
  open([](const Attributes&) { return true; });
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
  // The command that shades the shot chooses displacements again.
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
  services_->useCheckpoint(kept_);
  shading_->setServices(services_.get());
  setLightSources(*services_, *method_,
                  {raySource_, scene_, *shading_, camera_, settings_, meter_.makingMaps(), kept_, stats_, log_});
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

Preview* FrameJob::preview(const DeepFrame& layout) {
  if (!preview_ && !settings_.report.preview.empty())
    preview_ = std::make_unique<Preview>(settings_.report.preview, scene_.options.displays.front().name, layout, log_);
  return preview_.get();
}

void FrameJob::closePreview() { preview_.reset(); }

double FrameJob::elapsed_s() const {
  return settings_.quality.reading_s + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void FrameJob::setQuality(const LightQuality& quality) {
  quality_ = quality;
  if (services_) services_->startAgain(giSettings());
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

// The reference must not be noisier in direct light than in indirect.
int FrameJob::referenceLightSamples() const {
  const int samples = quality_.samples > 0 ? quality_.samples : kReferenceLightSamples;
  return std::min(std::max(samples, shading_->mostAreaSamples()), kMostReferenceLightSamples);
}

}  // namespace tomales
