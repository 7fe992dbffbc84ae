#include "reyes/app/frame/shot.h"

#include <fmt/format.h>

#include <atomic>

#include "reyes/app/frame/frame_light.h"
#include "reyes/app/frame/frame_picture.h"
#include "reyes/app/frame/frame_shaders.h"
#include "reyes/app/frame/hide.h"
#include "reyes/app/frame/outputs.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/app/frame/provenance.h"
#include "reyes/base/search_path.h"
#include "reyes/base/stop.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Lets shaders and pictures be found where the shot was hidden, if that is not the working folder.
void searchFrom(const fs::path& hidden, Scene& scene) {
  std::error_code unknown;
  if (hidden.empty() || fs::equivalent(hidden, ".", unknown)) return;
  for (const char* kind : {"shader", "texture"}) {
    std::string& path = scene.options.searchPaths[kind];
    path = alsoWithin(path, hidden.string());
    for (const fs::path& folder : {hidden, hidden / scene.where.folder()})
      path += (path.empty() ? "" : ":") + folder.string();
  }
}

}  // namespace

std::unique_ptr<ShotJob> ShotJob::open(const RenderSettings& settings, Stats& stats, Log& log) {
  auto files = ShotFiles::open(settings, log);
  return files ? open(std::move(files), settings, stats, log) : nullptr;
}

std::unique_ptr<ShotJob> ShotJob::open(std::shared_ptr<ShotFiles> files, const RenderSettings& settings, Stats& stats,
                                       Log& log) {
  std::unique_ptr<ShotJob> job(new ShotJob(std::move(files), settings, stats, log));
  return job->edit() ? std::move(job) : nullptr;
}

ShotJob::ShotJob(std::shared_ptr<ShotFiles> files, const RenderSettings& settings, Stats& stats, Log& log)
    : files_(std::move(files)), settings_(settings), stats_(stats), log_(log), shot_(files_->dfb().shot()) {
  settings_.picture.seed = shot_.seed;
  searchFrom(shot_.folder, shot_.scene);
}

ShotJob::~ShotJob() {
  if (job_ && job_->services() && files_->hasIrradiance()) files_->irradiance().caches = job_->services()->takeCaches();
}

bool ShotJob::edit() {
  for (const ShadeGroup& g : shot_.scene.groups) attributesOfFile_.push_back(g.attributes);
  if (!settings_.input.edits.empty() && !editScene(settings_.input.edits, shot_.scene, log_)) return false;
  applyOverrides(shot_.scene, settings_);
  nameOutputs(shot_.scene.options, settings_, log_);
  describeOutputs(shot_.scene.options, "", settings_);
  if (settings_.picture.crop) {
    const PixelRect asked = Camera(shot_.scene.options).crop(), &whole = shot_.frame.crop;
    shot_.frame.crop = {std::max(asked.x0, whole.x0), std::max(asked.y0, whole.y0), std::min(asked.x1, whole.x1),
                        std::min(asked.y1, whole.y1)};
  }
  if (shot_.frame.crop.width() > 0 && shot_.frame.crop.height() > 0) return true;
  log_.report(Severity::Error, "shot-crop", {}, "the shot has no pixels inside --crop");
  return false;
}

std::unique_ptr<Checkpoint> ShotJob::keptGather() const {
  if (!settings_.picture.resume) return nullptr;
  const std::string sum = sumOfShot(shot_, files_->irradianceSum(), sourcesOf(settings_.input.edits)),
                    contents =
                        contentsOfGather(shot_, files_->dfb().shotSum(), *files_->kept().shaders, sum, settings_);
  if (!contents.empty()) return Checkpoint::create(settings_.picture.output + ".kept", contents, log_);
  log_.report(
      Severity::Note, "resume", {},
      "--resume keeps nothing: the maps of --atlas, or files whose names shaders compute, are read while light is "
      "gathered and might change between runs");
  return nullptr;
}

void ShotJob::prepareLight() {
  KeptGeometry& geometry = files_->kept();
  if (!geometry.shaders) geometry.shaders = frameShaders(settings_, log_);
  world_ = std::make_unique<RayWorld>(shot_, geometry, settings_, stats_, log_);
  job_ = std::make_unique<FrameJob>(shot_.scene, *geometry.shaders, settings_, stats_, log_);
  kept_ = keptGather();
  job_->useCheckpoint(kept_.get());
  job_->prepareRays([this] { return world_->tools(); });
  world_->setServices(job_->services());
  if (files_->hasIrradiance()) {
    IrradianceShot& given = files_->irradiance();
    lightEdits_ = editsSince(given, shot_.scene, job_->shading());
    if (given.emitters && files_->isOfShot()) job_->services()->useEmitters(*given.emitters);
    if (given.learnt && files_->isOfShot() && settings_.input.edits.empty() && !gathers_)
      job_->services()->useLearnt(given.learnt);
    moveToCamera(given, shot_.scene.cameraFromWorldAtOpen());
    std::optional<PixelRect> anew;
    if (gathersAnew_) {
      dropRecordsOfCrop(given.caches);
      anew = shot_.frame.crop;
    }
    if (gathers_) takeEdits(given.caches);
    job_->services()->useCaches(std::move(given.caches), anew);
  }
  prepareShares();
}

void ShotJob::prepareShares() {
  const bool given = files_->hasIrradiance();
  std::vector<std::string> groups = given ? files_->irradiance().groups : std::vector<std::string>();
  const GiMode mode = job_->giSettings().mode;
  const bool shared = mode == GiMode::Gather || (mode == GiMode::None && job_->gathers());
  if (settings_.stored.byLight && (given ? groups.empty() : !shared))
    return log_.report(Severity::Warning, "light-shares", {},
                       given ? "--by-light: the records of --irradiance have no shares; new ones get none either"
                             : "--by-light: only --gi gather knows which light has bounced");
  if (settings_.stored.byLight && !given) groups = groupsOfLights(shot_.scene, job_->shading());
  if (!groups.empty()) job_->shading().runAllLights();
  job_->services()->keepShares(groups);
  if (given && !gathers_) job_->services()->mixShares(lightEdits_.gains);
}

std::vector<std::string> ShotJob::staleLight() const {
  // Records of occlusion() do not depend on lights.
  const bool holdLight = files_->hasIrradiance() &&
                         (files_->irradiance().settings.mode != GiMode::None ||
                          std::ranges::any_of(job_->services()->caches(),
                                              [](const PreparedCache& c) { return !c.key.gather.isOcclusion(); }));
  if (!holdLight) return {};
  std::set<std::string> changed;
  for (const std::string& handle : lightEdits_.stale) changed.insert("light \"" + handle + "\"");
  for (size_t g = 0; g < attributesOfFile_.size(); ++g) {
    const Attributes &now = *shot_.scene.groups[g].attributes, &then = *attributesOfFile_[g];
    if (now.surface != then.surface || now.color != then.color || now.opacity != then.opacity)
      changed.insert(now.name.empty() ? "objects without a name" : "\"" + now.name + "\"");
  }
  return {changed.begin(), changed.end()};
}

void ShotJob::warnOfStaleLight() const {
  const std::vector<std::string> changed = staleLight();
  if (changed.empty()) return;
  log_.report(
      Severity::Warning, "light-stale", wholeFile(settings_.stored.irradiance),
      fmt::format("keeps the bounced light of {} as it was when it was gathered: direct light is that of the edit; "
                  "gather again for the rest",
                  fmt::join(changed, ", ")));
}

std::shared_ptr<const DeepTile> ShotJob::read(size_t index) const {
  auto tile = files_->load(index, log_);
  return tile ? std::make_shared<const DeepTile>(std::move(*tile)) : nullptr;
}

void ShotJob::shadePicture() {
  if (!displaysAreWritable(shot_.scene.options, settings_, log_)) return;
  checkDisplays(shot_.scene.options, log_);
  describeShot(shot_.scene.options, sumOfShot(shot_, files_->irradianceSum(), sourcesOf(settings_.input.edits)),
               settings_);
  prepareLight();
  const bool gathers = job_->gathersBeside(files_->hasIrradiance() && !settings_.stored.appendIrradiance);
  job_->setShares(0, gathers ? 0.6f : 0);
  if (!gathers) {
    warnOfStaleLight();
    if (files_->hasIrradiance()) checkRecords(files_->irradiance().settings, settings_.stored.irradiance, *job_, log_);
  }
  FrameLight(*job_, shot_.frame, [this](size_t index) { return read(index); }).make(gathers);
  writePicture(*job_, shot_.frame, [this](size_t index) { return files_->load(index, log_); });
  world_->report();
}

void ShotJob::prepareToShow(const std::string& more) {
  std::vector<DisplayCall>& displays = shot_.scene.options.displays;
  displays = {DisplayCall{}};
  if (!more.empty()) displays.emplace_back().mode = more;
  prepareLight();
  job_->shading().runAllLights();
}

void ShotJob::choose(const std::string* lights, bool indirect) {
  shown_ = {lights, indirect};
  const std::vector<std::string>& groups = shareGroups();
  if (groups.empty()) return;
  std::vector<vec3> gains = lightEdits_.gains, chosen;
  if (lights) chosen.assign(groups.size(), vec3(1.0f));
  for (size_t g = 1; g < chosen.size(); ++g)
    if (groups[g] != *lights) chosen[g] = vec3(0.0f);
  if (gains.empty()) gains = chosen;
  for (size_t g = 0; g < chosen.size(); ++g) gains[g] *= chosen[g];
  job_->services()->mixShares(std::move(gains), std::move(chosen));
}

void ShotJob::show(const PixelRect& window, const ShownTiles& tiles, const RowViewer& viewer, StopToken stop) {
  showWindow(*job_, shot_.frame, window, tiles, shown_, viewer, stop);
}

void ShotJob::shadeApart(std::span<DeepTile> tiles) { tomales::shadeApart(*job_, tiles, shown_); }

void ShotJob::dropRecordsOfCrop(std::vector<PreparedCache>& caches) const {
  const PixelRect& crop = shot_.frame.crop;
  for (PreparedCache& prepared : caches) {
    IrradianceCache kept(prepared.cache.bound(), prepared.key.cache);
    for (const IrradianceRecord& r : prepared.cache.records()) {
      const vec2 at = job_->camera().seeable(r.position) ? job_->camera().raster(r.position) : vec2(-1e9f);
      if (!crop.contains(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)))) kept.restore(r);
    }
    prepared.cache = std::move(kept);
  }
}

void ShotJob::takeEdits(std::vector<PreparedCache>& caches) const {
  if (lightEdits_.gains.empty()) return;
  for (PreparedCache& prepared : caches) {
    if (prepared.key.gather.isOcclusion()) continue;
    IrradianceCache edited(prepared.cache.bound(), prepared.key.cache);
    for (const IrradianceRecord& r : prepared.cache.records()) edited.restore(withGains(r, lightEdits_.gains));
    prepared.cache = std::move(edited);
  }
}

std::vector<std::shared_ptr<LightCall>> ShotJob::lightsOfRecords() const {
  std::vector<std::shared_ptr<LightCall>> out(shot_.scene.lights.begin(), shot_.scene.lights.end());
  if (!files_->hasIrradiance()) return out;
  const auto& given = files_->irradiance().lights;
  for (size_t l = 0; l < std::min(given.size(), out.size()); ++l)
    if (std::ranges::count(lightEdits_.stale, out[l]->handle) > 0) out[l] = given[l];
  return out;
}

bool ShotJob::copyAnswers(const std::set<uint32_t>& except, IcfWriter& out) {
  if (!files_->isOfShot()) return true;
  std::string error;
  for (uint32_t i = 0; i < shot_.frame.tileCount(); ++i) {
    if (except.contains(i)) continue;
    auto answers = files_->answers(i, error);
    if (!answers || answers->empty()) continue;
    for (RayAnswers& batch : *answers)
      for (auto& [name, answer] : batch.indirect)
        if (!answer.shares.empty() && answer.shares.size() == lightEdits_.gains.size())
          answer = withGains(std::move(answer), lightEdits_.gains);
    if (!out.writeAnswers(i, *answers)) return false;
  }
  return true;
}

void ShotJob::gatherIrradiance() {
  const auto unwritten = [&](const std::string& why) {
    log_.report(Severity::Output, "icf-write", {}, "\"" + settings_.picture.output + "\" could not be written: " + why);
  };
  if (!hasFolder(settings_.picture.output, {}, log_)) return;
  std::string error;
  const auto out = IcfWriter::create(settings_.picture.output, error);
  if (!out) return unwritten(error);
  gathers_ = true;
  gathersAnew_ = settings_.picture.crop.has_value();
  prepareLight();
  const RayTools* tools = world_->tools();
  if (!tools) return;
  const std::vector<uint32_t> asked = tilesOf(shot_.frame, shot_.scene.options);
  const std::set<uint32_t> inCrop(asked.begin(), asked.end());
  job_->setShares(0, 0.8f);
  // Points outside of the crop whose records were dropped, because records of the crop reached there, are gathered too.
  FrameLight(*job_, shot_.frame, [&](size_t index) {
    return files_->hasIrradiance() || inCrop.contains(static_cast<uint32_t>(index)) ? read(index) : nullptr;
  }).gather();
  const bool written = !settings_.stored.keepsAnswers || (recordAnswers(*out) && copyAnswers(inCrop, *out));
  IrradianceShot shot{stopRequested() ? 0 : files_->dfb().shotSum(),
                      job_->giSettings(),
                      shot_.scene.cameraFromWorldAtOpen(),
                      {},
                      tools->rays->emitters().table(),
                      lightsOfRecords(),
                      job_->services()->shareGroups(),
                      job_->services()->learnt()};
  shot.caches = job_->services()->takeCaches();
  world_->report();
  if (!written || !out->finish(shot)) return unwritten(out->error());
  stats_.addOutput(settings_.picture.output);
  if (kept_ && !stopRequested()) kept_->forget();
}

// Shades the picture once, for the answers of its rays.
bool ShotJob::recordAnswers(IcfWriter& out) {
  const StageTimer timer(stats_, "answers");
  std::atomic<bool> good{true};
  RayAnswers none;
  none.recording = true;
  const auto startRecording = [&](size_t index, DeepTile& tile) {
    auto loaded = files_->load(index, log_);
    if (!loaded) return false;
    tile = std::move(*loaded);
    tile.answers.assign(tile.batches.size(), none);
    return true;
  };
  const auto store = [&](size_t index, DeepTile&& tile) {
    if (!out.writeAnswers(index, tile.answers)) good = false;
  };
  shadeBuckets(*job_, tilesOf(shot_.frame, shot_.scene.options), {startRecording, store});
  return good;
}

}  // namespace tomales
