#include "reyes/app/relight/relit_shot.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr int64_t kTilesHeld_bytes = int64_t{640} << 20;  ///< Other tiles are read anew by every pass.

}  // namespace

RelitShot::RelitShot(const RenderSettings& settings, Stats& stats, Log& log)
    : settings_(settings), stats_(stats), log_(log), folder_(std::filesystem::temp_directory_path()) {}

std::unique_ptr<ShotJob> RelitShot::open() {
  if (settings_.stored.irradiance.empty() && !gatherFirst()) return nullptr;
  if (stopRequested() || !openFiles()) return nullptr;
  auto job = ShotJob::open(files_, settings_, stats_, log_);
  if (!job) return nullptr;
  job->prepareToShow();
  editable_ = std::make_unique<Editable>(job->shot().scene, *files_->kept().shaders, pluginTrust(settings_));
  return job;
}

bool RelitShot::gatherFirst() {
  auto job = ShotJob::open(settings_, stats_, log_);
  if (!job) return false;
  job->prepareToShow();
  const bool gathers = job->job().gathers();
  job.reset();
  if (!gathers) return true;
  RenderSettings gather = settings_;
  gather.picture.output = (folder_.path() / "shot.icf").string();
  gather.stored.byLight = true;
  if ((job = ShotJob::open(gather, stats_, log_))) job->gatherIrradiance();
  // Without the geometry nothing can be gathered; the job has said that indirect light is left out.
  if (std::filesystem::exists(gather.picture.output)) settings_.stored.irradiance = gather.picture.output;
  return true;
}

/// Opens the files anew; what has been loaded of the shot stays.
bool RelitShot::openFiles() {
  auto files = ShotFiles::open(settings_, log_);
  if (!files) return false;
  if (files_) files->kept() = std::move(files_->kept());
  {
    const std::lock_guard lock(mutex_);
    files_ = std::move(files);
  }
  const int64_t budget_bytes =
      settings_.resources.memoryLimit ? *settings_.resources.memoryLimit / 2 : kTilesHeld_bytes;
  tiles_ = std::make_unique<TileStore>(files_->dfb().shot().frame.tileCount(), budget_bytes,
                                       [this](size_t index) { return files_->load(index, log_); });
  return true;
}

EditState RelitShot::takeGivenEdit() {
  if (settings_.input.edits.empty()) return {};
  try {
    EditState out = stateOfRib(settings_.input.edits, *editable_);
    settings_.input.edits.clear();
    return out;
  } catch (const BadRequest& e) {
    log_.report(Severity::Warning, "relight-edit", wholeFile(settings_.input.edits.front()),
                fmt::format("applies before the changes of the page, which do not save it: {}", e.what()));
    return {};
  }
}

std::shared_ptr<const ShotFiles> RelitShot::files() const {
  const std::lock_guard lock(mutex_);
  return files_;
}

std::string RelitShot::writeEdit(const EditState& edit) const {
  const std::string file = (folder_.path() / "edit.rib").string();
  std::ofstream(file) << ribOf(edit, *editable_);
  return file;
}

ShotJob& RelitShot::jobFor(const EditState& edit, const std::string& variable) {
  const std::string text = ribOf(edit, *editable_) + variable;
  if (job_ && text == textOfJob_) return *job_;
  job_.reset();  // it gives the records back
  RenderSettings settings = settings_;
  settings.input.edits.push_back(writeEdit(edit));
  job_ = ShotJob::open(files_, settings, stats_, log_);
  if (!job_) throw std::runtime_error("the edit cannot be applied");
  job_->prepareToShow(variable);
  staleLight_ = job_->staleLight();
  textOfJob_ = text;
  return *job_;
}

std::string RelitShot::gather(const EditState& edit, const PixelRect& p) {
  const Options& options = files_->dfb().shot().scene.options;
  const auto width = static_cast<float>(options.xResolution), height = static_cast<float>(options.yResolution);
  RenderSettings settings = settings_;
  settings.input.edits.push_back(writeEdit(edit));
  settings.picture.crop = {static_cast<float>(p.x0) / width, static_cast<float>(p.x1) / width,
                           static_cast<float>(p.y0) / height, static_cast<float>(p.y1) / height};
  settings.picture.output = (folder_.path() / fmt::format("gathered-{}.icf", gatherings_++)).string();
  job_.reset();
  if (auto job = ShotJob::open(files_, settings, stats_, log_)) job->gatherIrradiance();
  const std::string before = settings_.stored.irradiance;
  const bool isGathered = std::filesystem::exists(settings.picture.output);
  if (isGathered) settings_.stored.irradiance = settings.picture.output;
  if (!openFiles()) throw std::runtime_error("what was gathered cannot be read");
  if (before.starts_with(folder_.path().string()) && before != settings_.stored.irradiance)
    std::filesystem::remove(before);
  return isGathered ? settings_.stored.irradiance : "";
}

const Attributes* nearestAt(const Shot& shot, const DeepTile& tile, int x, int y) {
  const DeepPixel& pixel = tile.pixel(x, y);
  if (pixel.count == 0) return nullptr;
  const Facet& nearest = tile.facets[tile.fragments[pixel.first].facet];
  const int group = tile.batches[static_cast<size_t>(nearest.batch)].group();
  return shot.scene.groups[static_cast<size_t>(group)].attributes.get();
}

}  // namespace tomales
