#include "reyes/app/relight/relighting.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "reyes/app/frame/frame_shaders.h"
#include "reyes/app/relight/relighting_layers.h"
#include "reyes/app/watch/interrupt.h"

namespace tomales {
namespace {

constexpr int64_t kTilesHeld_bytes = int64_t{640} << 20;  ///< Other tiles are read anew by every pass.
constexpr int kBucketsAcross = 4;                         ///< Buckets along an edge of a part that is shaded at once.

/// Tells whether light may add up on other surfaces under one edit than under the other. Parameters of a light change
/// what arrives, and not what a surface makes of it.
bool mayBeLinearElsewhere(const EditState& a, const EditState& b) {
  const auto lights = [](const EditState& s) {
    std::map<std::string, std::string> out;
    for (const auto& [owner, edit] : s.shaders[kLights])
      if (!edit.shader.empty()) out.emplace(owner, edit.shader);
    return out;
  };
  const auto lightLinks = [](const EditState& s) {
    std::map<std::string, std::map<std::string, bool>> out;
    for (const auto& [object, edit] : s.objects)
      if (!edit.lights.empty()) out.emplace(object, edit.lights);
    return out;
  };
  return lightLinks(a) != lightLinks(b) || a.shaders[kSurfaces] != b.shaders[kSurfaces] ||
         a.shaders[kAtmospheres] != b.shaders[kAtmospheres] || lights(a) != lights(b);
}

}  // namespace

Relighting::Relighting(const RenderSettings& settings, Stats& stats, Log& log)
    : settings_(settings), stats_(stats), log_(log), folder_(std::filesystem::temp_directory_path()) {
  settings_.report.watcher = [this](const char* doing, float done) { tell(doing, done); };
}

Relighting::~Relighting() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  cancel_ = true;
  changed_.notify_all();
  if (layers_) layers_->wake();
  if (thread_.joinable()) thread_.join();
}

void Relighting::tell(const char* doing, float done) {
  const std::lock_guard lock(mutex_);
  doing_ = doing;
  done_ = done;
}

bool Relighting::prepare() {
  if (settings_.stored.irradiance.empty()) {
    auto job = ShotJob::open(settings_, stats_, log_);
    if (!job) return false;
    job->prepareToShow();
    const bool gathers = job->job().gathers();
    job.reset();
    if (gathers) {
      RenderSettings gather = settings_;
      gather.picture.output = (folder_.path() / "shot.icf").string();
      gather.stored.byLight = true;
      if ((job = ShotJob::open(gather, stats_, log_))) job->gatherIrradiance();
      job.reset();
      // Without the geometry nothing can be gathered; the job has said that indirect light is left out.
      if (std::filesystem::exists(gather.picture.output)) settings_.stored.irradiance = gather.picture.output;
    }
  }
  if (interrupted() || !openFiles()) return false;
  auto job = ShotJob::open(files_, settings_, stats_, log_);
  if (!job) return false;
  job->prepareToShow();
  editable_ = std::make_unique<Editable>(job->shot().scene, *files_->kept().shaders, pluginTrust(settings_));
  window_ = job->shot().frame.crop;
  pointerX_ = window_.x0 + window_.width() / 2;
  pointerY_ = window_.y0 + window_.height() / 2;
  layOutParts();
  listLayers(*job);
  job.reset();
  takeGivenEdits();
  wantPresent();
  layers_ = std::make_unique<LayerStore>(window_, list_.size());
  sketch_ = std::make_unique<SketchPoints>(window_, parts_.size());
  shared_.resize(list_.size());
  return true;
}

/// Opens the files anew; what has been loaded of the shot stays.
bool Relighting::openFiles() {
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

// An edit of the command line is where the page begins, so that it is part of what the page saves.
void Relighting::takeGivenEdits() {
  if (settings_.input.edits.empty()) return;
  try {
    present_ = stateOfRib(settings_.input.edits, *editable_);
    settings_.input.edits.clear();
  } catch (const BadRequest& e) {
    log_.report(Severity::Warning, "relight-edit", wholeFile(settings_.input.edits.front()),
                fmt::format("stays below what the page changes, and is no part of what it saves: {}", e.what()));
  }
}

void Relighting::listLayers(const ShotJob& job) {
  const bool gathers = job.job().method().mode == GiMode::Gather && job.job().gathers();
  const bool bounces = job.job().method().mode != GiMode::None;
  // Paths of the reference know whose light they bring; records do if they keep shares.
  sharesBounces_ = !bounces || job.job().method().mode == GiMode::Reference || (gathers && !job.shareGroups().empty());
  list_ = {{"everything", std::nullopt}, {"glow", "", sharesBounces_}};
  std::map<std::string, std::vector<std::string>> groups;
  for (const auto& light : job.shot().scene.lights)
    if (const std::string group = job.job().shading().lightGroup(light->index); !group.empty())
      groups[group].push_back(light->handle);
  for (const auto& [name, handles] : groups) list_.push_back({name, name, sharesBounces_, handles});
  if (!sharesBounces_) list_.push_back({"bounced light", "", true});
  list_.push_back({"variable", std::nullopt});
  for (Layer& layer : list_) layer.parts = LayerParts(parts_.size());
}

// Squares of buckets.
void Relighting::layOutParts() {
  const DeepFrame& frame = files_->dfb().shot().frame;
  const int across = kBucketsAcross * frame.bucketWidth, down = kBucketsAcross * frame.bucketHeight;
  partGrid_ = {(frame.columns + kBucketsAcross - 1) / kBucketsAcross,
               (frame.rows + kBucketsAcross - 1) / kBucketsAcross};
  for (int row = 0; row < partGrid_.y; ++row)
    for (int column = 0; column < partGrid_.x; ++column) {
      const int x = frame.padded.x0 + column * across, y = frame.padded.y0 + row * down;
      // The last ones may be made of the filter's margin alone: they have no pixels then.
      parts_.push_back({std::clamp(x, window_.x0, window_.x1), std::clamp(y, window_.y0, window_.y1),
                        std::clamp(x + across, window_.x0, window_.x1), std::clamp(y + down, window_.y0, window_.y1)});
    }
}

size_t Relighting::partOfBucket(size_t bucket) const {
  const auto columns = static_cast<size_t>(files_->dfb().shot().frame.columns);
  return bucket / columns / kBucketsAcross * static_cast<size_t>(partGrid_.x) + bucket % columns / kBucketsAcross;
}

/// Tells whether another part of the layer will need a bucket: parts reach one bucket beyond their border.
bool Relighting::isNeededBesides(const Layer& layer, size_t bucket, size_t part) const {
  const auto columns = static_cast<size_t>(files_->dfb().shot().frame.columns);
  const int x = static_cast<int>(bucket % columns), y = static_cast<int>(bucket / columns);
  for (const int dy : {-1, 1})
    for (const int dx : {-1, 1}) {
      const int column = std::clamp((x + dx) / kBucketsAcross, 0, partGrid_.x - 1),
                row = std::clamp((y + dy) / kBucketsAcross, 0, partGrid_.y - 1);
      const auto other = static_cast<size_t>(row * partGrid_.x + column);
      if (other != part && layer.parts.isOld(other)) return true;
    }
  return false;
}

void Relighting::start() {
  thread_ = std::thread([this] { work(); });
}

/// Tells whether the page mixes the layer by the factor of this light. Lights of one layer may each have another.
bool Relighting::isMixed(const Layer& layer, const std::string& handle) const {
  return layer.handles.size() == 1 && layer.handles.front() == handle;
}

// The whole shows the present edit. The others show their lights in a strength that does not follow what only
// multiplies them, so that each part of a layer, however old, is mixed by the same factor.
EditState Relighting::editFor(const Layer& layer) const {
  if (!layer.lights) return present_;
  EditState out = present_;
  out.exposure.reset();
  out.shaders[kImagers].clear();
  for (const Layer& each : list_)
    for (const std::string& handle : each.handles) {
      if (!isMixed(each, handle)) continue;
      ShaderEdit& edit = out.shaders[kLights][handle];
      for (const EditableParam& p : shaderUnder(present_, kLights, handle, *editable_).params) {
        if (!isFactor(p.role)) continue;
        edit.params.erase(p.name);
        if (const auto unit = unitOf(p); unit != p.value.numbers) edit.params[p.name] = {unit, {}};
      }
      if (edit == ShaderEdit{}) out.shaders[kLights].erase(handle);
    }
  return out;
}

std::string Relighting::textFor(const Layer& layer) const {
  EditState edit = editFor(layer);
  if (layer.lights) {
    const auto belongsElsewhere = [&](const auto& ofLight) {
      const auto has = [&](const Layer& l) { return std::ranges::count(l.handles, ofLight.first) > 0; };
      return !has(layer) && std::ranges::any_of(list_, has);
    };
    std::erase_if(edit.shaders[kLights], belongsElsewhere);
    for (auto& [name, object] : edit.objects) std::erase_if(object.lights, belongsElsewhere);
  }
  return ribOf(edit, *editable_) + (&layer == &list_.back() ? variable_ : "");
}

// Pre: the mutex is locked, or nobody else is there yet.
void Relighting::wantPresent() {
  for (Layer& layer : list_) {
    const uint32_t before = layer.parts.wanted();
    layer.parts.want(textFor(layer));
    if (layer.parts.wanted() != before) layer.changed = Clock::now();
  }
  if (running_ && !isWantedStill(*running_)) cancel_ = true;
  changed_.notify_all();
}

void Relighting::edit(const Json& json) {
  const EditState state = stateOf(json, *editable_);
  const std::lock_guard lock(mutex_);
  if (mayBeLinearElsewhere(state, present_)) checked_ = false;
  present_ = state;
  wantsWhole_ = false;
  wantPresent();
}

EditState Relighting::present() const {
  const std::lock_guard lock(mutex_);
  return present_;
}

std::string Relighting::gatheredFile() const {
  const std::lock_guard lock(mutex_);
  return gatheredFile_;
}

void Relighting::pointAt(int x, int y) {
  const std::lock_guard lock(mutex_);
  pointerX_ = window_.x0 + x;
  pointerY_ = window_.y0 + y;
}

/// Returns the pixels by their raster coordinates.
PixelRect Relighting::insideOfWindow(const PixelRect& p) const {
  const PixelRect out{
      window_.x0 + std::clamp(p.x0, 0, window_.width()), window_.y0 + std::clamp(p.y0, 0, window_.height()),
      window_.x0 + std::clamp(p.x1, 0, window_.width()), window_.y0 + std::clamp(p.y1, 0, window_.height())};
  if (out.width() < 1 || out.height() < 1) throw BadRequest("this region is outside of the picture");
  return out;
}

void Relighting::shadeOnly(const std::optional<PixelRect>& pixels) {
  const std::lock_guard lock(mutex_);
  only_ = pixels ? std::optional(insideOfWindow(*pixels)) : std::nullopt;
  changed_.notify_all();
}

void Relighting::askForWhole() {
  const std::lock_guard lock(mutex_);
  wantsWhole_ = true;
  changed_.notify_all();
}

void Relighting::askForVariable(const std::string& name) {
  const std::vector<std::string> known = variablesOf(files()->dfb().shot().scene.options);
  if (!name.empty() && std::ranges::count(known, name) == 0) throw BadRequest("there is no variable of this name");
  const std::lock_guard lock(mutex_);
  variable_ = name;
  wantPresent();
}

void Relighting::askToGather(const PixelRect& pixels) {
  const PixelRect inside = insideOfWindow(pixels);
  const std::lock_guard lock(mutex_);
  toGather_ = inside;
  changed_.notify_all();
}

bool Relighting::isGathering() const {
  const std::lock_guard lock(mutex_);
  return toGather_.has_value();
}

std::vector<float> Relighting::whole() {
  const std::lock_guard lock(mutex_);
  std::vector<float> out;
  if (list_[kWhole].parts.areOld() || finished_.pixels.empty()) return out;
  for (int y = 0; y < finished_.height; ++y)
    for (int x = 0; x < finished_.width; ++x) {
      const vec3 c = colorAt(finished_, x, y);
      out.insert(out.end(), {c.x, c.y, c.z});
    }
  return out;
}

}  // namespace tomales
