#include "reyes/app/frame/shot.h"

#include <fmt/format.h>

#include <atomic>

#include "reyes/app/frame/frame_shaders.h"
#include "reyes/app/frame/hide.h"
#include "reyes/app/frame/outputs.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/app/frame/provenance.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

SourceLoc wholeFile(const std::string& path) { return {std::make_shared<std::string>(path), 0}; }

}  // namespace

std::unique_ptr<ShotJob> ShotJob::open(const RenderSettings& settings, Stats& stats, Log& log) {
  std::string error;
  auto file = DfbFile::open(settings.files.front(), error);
  if (!file) {
    log.report(Severity::Error, "dfb-read", wholeFile(settings.files.front()),
               "cannot be read as a deep frame buffer: " + error);
    return nullptr;
  }
  std::unique_ptr<ShotJob> job(new ShotJob(std::move(file), settings, stats, log));
  return job->edit() && job->openIrradiance() ? std::move(job) : nullptr;
}

ShotJob::ShotJob(std::unique_ptr<DfbFile> file, const RenderSettings& settings, Stats& stats, Log& log)
    : file_(std::move(file)), settings_(settings), stats_(stats), log_(log), shot_(file_->shot()) {
  settings_.seed = shot_.seed;
}

bool ShotJob::edit() {
  lightsOfFile_ = shot_.scene.lights;
  for (const ShadeGroup& g : shot_.scene.groups) attributesOfFile_.push_back(g.attributes);
  if (!settings_.edits.empty() && !editScene(settings_.edits, shot_.scene, log_)) return false;
  applyOverrides(shot_.scene, settings_);
  nameOutputs(shot_.scene.options, settings_, log_);
  describeOutputs(shot_.scene.options, "", settings_);
  if (settings_.crop) {
    const PixelRect asked = Camera(shot_.scene.options).crop(), &whole = shot_.frame.crop;
    shot_.frame.crop = {std::max(asked.x0, whole.x0), std::max(asked.y0, whole.y0), std::min(asked.x1, whole.x1),
                        std::min(asked.y1, whole.y1)};
  }
  if (shot_.frame.crop.width() > 0 && shot_.frame.crop.height() > 0) return true;
  log_.report(Severity::Error, "shot-crop", {}, "the shot has no pixels inside --crop");
  return false;
}

bool ShotJob::openIrradiance() {
  if (settings_.irradiance.empty()) return true;
  std::string error;
  irradiance_ = IcfFile::open(settings_.irradiance, error);
  if (!irradiance_) {
    log_.report(Severity::Error, "icf-read", wholeFile(settings_.irradiance),
                "cannot be read as an irradiance cache: " + error);
    return false;
  }
  if (irradiance_->shot().shot != file_->shotSum())
    log_.report(Severity::Warning, "icf-shot", wholeFile(settings_.irradiance),
                "was gathered for another shot: its irradiance is used, its shadows are not");
  return true;
}

void ShotJob::prepareLight() {
  shaders_ = frameShaders(settings_, log_);
  world_ = std::make_unique<RayWorld>(shot_, *shaders_, settings_, stats_, log_);
  job_ = std::make_unique<FrameJob>(shot_.scene, *shaders_, settings_, stats_, log_);
  job_->prepareRays([this] { return world_->tools(); });
  world_->setServices(job_->services());
  if (!irradiance_) return;
  IrradianceShot given = irradiance_->takeShot();
  if (given.emitters && given.shot == file_->shotSum()) job_->services()->useEmitters(std::move(*given.emitters));
  moveToCamera(given, shot_.scene.cameraFromWorldAtOpen());
  std::optional<PixelRect> anew;
  if (gathersAnew_) dropRecordsOfCrop(given.caches), anew = shot_.frame.crop;
  job_->services()->useCaches(std::move(given.caches), anew);
}

void ShotJob::warnOfStaleLight() const {
  if (!irradiance_ || irradiance_->shot().settings.mode == GiMode::None) return;
  std::set<std::string> changed;
  for (size_t l = 0; l < lightsOfFile_.size(); ++l) {
    const LightKind kind = job_->shading().lightKind(static_cast<int>(l));
    const bool bounces = kind != LightKind::None && kind != LightKind::Indirect && kind != LightKind::Ambient;
    if (bounces && shot_.scene.lights[l] != lightsOfFile_[l])
      changed.insert("light \"" + shot_.scene.lights[l]->handle + "\"");
  }
  for (size_t g = 0; g < attributesOfFile_.size(); ++g) {
    const Attributes &now = *shot_.scene.groups[g].attributes, &then = *attributesOfFile_[g];
    if (now.surface != then.surface || now.color != then.color || now.opacity != then.opacity)
      changed.insert(now.name.empty() ? "objects without a name" : "\"" + now.name + "\"");
  }
  if (changed.empty()) return;
  log_.report(
      Severity::Warning, "light-stale", wholeFile(settings_.irradiance),
      fmt::format("keeps the bounced light of {} as it was when it was gathered: direct light is that of the edit; "
                  "gather again for the rest",
                  fmt::join(changed, ", ")));
}

std::optional<DeepTile> ShotJob::load(size_t index) {
  std::string error;
  auto tile = file_->tile(index, error);
  if (!tile) {
    log_.report(Severity::Error, "dfb-bucket", wholeFile(settings_.files.front()),
                "bucket " + std::to_string(index) + " is left out of the picture: " + error);
    return tile;
  }
  if (!irradiance_ || irradiance_->shot().shot != file_->shotSum()) return tile;
  if (auto answers = irradiance_->answers(index, error)) {
    tile->answers = std::move(*answers);
  } else {
    log_.report(Severity::Error, "icf-bucket", wholeFile(settings_.irradiance),
                "the shadows of bucket " + std::to_string(index) + " are traced anew: " + error);
  }
  return tile;
}

std::shared_ptr<const DeepTile> ShotJob::read(size_t index) {
  auto tile = load(index);
  return tile ? std::make_shared<const DeepTile>(std::move(*tile)) : nullptr;
}

void ShotJob::shadePicture() {
  if (!displaysHaveFolders(shot_.scene.options, pluginTrust(settings_), log_)) return;
  checkDisplays(shot_.scene.options, log_);
  describeShot(shot_.scene.options, sumOfShot(shot_, irradiance_ ? irradiance_->sum() : 0, sourcesOf(settings_.edits)),
               settings_);
  prepareLight();
  const TileReader read = [this](size_t index) { return this->read(index); };
  const bool gathers = job_->gathersBeside(irradiance_ && !settings_.appendIrradiance);
  if (!gathers) {
    warnOfStaleLight();
    if (irradiance_) job_->checkRecords(irradiance_->shot().settings, settings_.irradiance);
  }
  job_->light(shot_.frame, read, gathers);
  job_->write(shot_.frame, [this](size_t index) { return load(index); });
  world_->report();
}

void ShotJob::dropRecordsOfCrop(std::vector<PreparedCache>& caches) const {
  const PixelRect& crop = shot_.frame.crop;
  for (PreparedCache& prepared : caches) {
    IrradianceCache kept(prepared.cache.bound(), prepared.plan.cache);
    for (const IrradianceRecord& r : prepared.cache.records()) {
      const vec2 at = job_->camera().seeable(r.position) ? job_->camera().raster(r.position) : vec2(-1e9f);
      if (!crop.contains(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)))) kept.restore(r);
    }
    prepared.cache = std::move(kept);
  }
}

bool ShotJob::copyAnswers(const std::set<uint32_t>& except, IcfWriter& out) {
  if (!irradiance_ || irradiance_->shot().shot != file_->shotSum()) return true;
  std::string error;
  for (uint32_t i = 0; i < shot_.frame.tileCount(); ++i) {
    if (except.contains(i)) continue;
    const auto answers = irradiance_->answers(i, error);
    if (answers && !answers->empty() && !out.writeAnswers(i, *answers)) return false;
  }
  return true;
}

void ShotJob::gatherIrradiance() {
  const auto unwritten = [&](const std::string& why) {
    log_.report(Severity::Output, "icf-write", {}, "\"" + settings_.output + "\" could not be written: " + why);
  };
  if (!hasFolder(settings_.output, {}, log_)) return;
  std::string error;
  const auto out = IcfWriter::create(settings_.output, error);
  if (!out) return unwritten(error);
  gathersAnew_ = settings_.crop.has_value();
  prepareLight();
  const RayTools* tools = world_->tools();
  if (!tools) return;
  const std::vector<uint32_t> asked = tilesOf(shot_.frame, shot_.scene.options);
  const std::set<uint32_t> inCrop(asked.begin(), asked.end());
  // Points outside the crop that have lost records, because those of the crop reached there, are gathered too.
  job_->gather(shot_.frame, [&](size_t index) {
    return irradiance_ || inCrop.contains(static_cast<uint32_t>(index)) ? read(index) : nullptr;
  });
  const bool written = recordAnswers(*out) && copyAnswers(inCrop, *out);
  IrradianceShot shot{interrupted() ? 0 : file_->shotSum(),
                      job_->giSettings(),
                      shot_.scene.cameraFromWorldAtOpen(),
                      {},
                      tools->rays->emitters().table()};
  shot.caches = job_->services()->takeCaches();
  world_->report();
  if (!written || !out->finish(shot)) unwritten(out->error());
}

// Shades the picture once, for the answers of its rays.
bool ShotJob::recordAnswers(IcfWriter& out) {
  const StageTimer timer(stats_, "answers");
  std::atomic<bool> good{true};
  const auto startRecording = [&](size_t index, DeepTile& tile) {
    auto loaded = load(index);
    if (!loaded) return false;
    tile = std::move(*loaded);
    tile.answers.assign(tile.batches.size(), RayAnswers{true, {}, {}});
    return true;
  };
  const auto store = [&](size_t index, DeepTile&& tile) {
    if (!out.writeAnswers(index, tile.answers)) good = false;
  };
  job_->shade(tilesOf(shot_.frame, shot_.scene.options), {startRecording, store});
  return good;
}

}  // namespace tomales
