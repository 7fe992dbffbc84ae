#include "reyes/app/relight/relighting.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "reyes/app/frame/frame_shaders.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr size_t kWhole = 0, kGlow = 1, kFirstLight = 2;
constexpr int64_t kTilesHeld_bytes = int64_t{1} << 30;  ///< Other tiles are read anew by every pass.
constexpr int kBucketsAcross = 4;                       ///< Buckets along an edge of a part that is shaded at once.

}  // namespace

Relighting::Relighting(const RenderSettings& settings, Stats& stats, Log& log)
    : settings_(settings), stats_(stats), log_(log), folder_(std::filesystem::temp_directory_path()) {}

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

bool Relighting::prepare() {
  if (settings_.irradiance.empty()) {
    auto job = ShotJob::open(settings_, stats_, log_);
    if (!job) return false;
    job->prepareToShow();
    const bool gathers = job->job().gathers();
    job.reset();
    if (gathers) {
      RenderSettings gather = settings_;
      gather.output = (folder_.path() / "shot.icf").string();
      gather.byLight = true;
      if ((job = ShotJob::open(gather, stats_, log_))) job->gatherIrradiance();
      job.reset();
      settings_.irradiance = gather.output;
    }
  }
  if (!(files_ = ShotFiles::open(settings_, log_))) return false;
  tiles_ = std::make_unique<TileStore>(files_->dfb().shot().frame.tileCount(), kTilesHeld_bytes,
                                       [this](size_t index) { return files_->load(index, log_); });
  auto job = ShotJob::open(files_, settings_, stats_, log_);
  if (!job) return false;
  job->prepareToShow();
  const std::unique_ptr<ShaderRegistry> shaders = frameShaders(settings_, log_);
  editable_ = editableOf(job->shot().scene, *shaders);
  window_ = job->shot().frame.crop;
  pointerX_ = window_.x0 + window_.width() / 2;
  pointerY_ = window_.y0 + window_.height() / 2;
  listLayers(*job);
  layers_ = std::make_unique<LayerStore>(window_, list_.size());
  return true;
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
}

void Relighting::start() {
  thread_ = std::thread([this] { work(); });
}

EditState Relighting::relevant(const Layer& layer, const EditState& state) const {
  const bool whole = !layer.lights;
  EditState out{{}, state.surfaces, whole ? state.exposure : std::nullopt};
  for (const auto& [handle, params] : state.lights) {
    const EditableShader& light = *std::ranges::find(editable_.lights, handle, &EditableShader::owner);
    const bool own = std::ranges::count(layer.handles, handle) > 0;
    const bool direct = std::ranges::any_of(
        list_, [owner = handle](const Layer& l) { return std::ranges::count(l.handles, owner) > 0; });
    if (!whole && !own && direct) continue;
    // The page mixes a layer by the factor of its light. Lights of one layer may each have another.
    const bool mixed = own && layer.handles.size() == 1;
    for (const auto& [name, value] : params)
      if (!mixed || !isFactor(std::ranges::find(light.params, name, &EditableParam::name)->role))
        out.lights[handle][name] = value;
  }
  return out;
}

bool Relighting::isOld(const Layer& layer, const std::optional<EditState>& held) const {
  return !held || !(relevant(layer, *held) == relevant(layer, present_));
}

// The whole picture comes first of all, and after an edit when the page asks for it. What shines by itself is taken
// off the other layers, so that it comes before them.
std::optional<Relighting::Pass> Relighting::next() const {
  if (wantsWhole_ && isOld(list_[kWhole], list_[kWhole].shaded)) return Pass{kWhole, present_};
  for (size_t i = kGlow; i < list_.size(); ++i)
    if (isOld(list_[i], list_[i].shaded)) return Pass{i, present_};
  return std::nullopt;
}

void Relighting::work() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    const std::optional<Pass> pass = next();
    if (!pass && checked_) {
      doing_.clear();
      layers_->wake();
      changed_.wait(lock);
      continue;
    }
    cancel_ = false;
    done_ = 0;
    doing_ = pass ? list_[pass->layer].name : "checking that light adds up";
    if (pass) {
      running_ = pass->layer;
      list_[pass->layer].begun = pass->state;
      ++list_[pass->layer].version;
    }
    lock.unlock();
    try {
      pass ? run(*pass) : checkLinearity();
    } catch (const std::exception& e) {
      log_.report(Severity::Error, "relight-failed", {}, std::string(e.what()) + "; a layer is not shaded");
    }
    lock.lock();
    running_.reset();
    if (cancel_) continue;
    if (pass)
      list_[pass->layer].shaded = pass->state;
    else
      checked_ = true;
  }
}

ShotJob& Relighting::jobFor(const EditState& state) {
  const std::string text = ribOf(state, editable_);
  if (job_ && text == textOfJob_) return *job_;
  job_.reset();  // it gives the records back
  const std::string file = (folder_.path() / "edit.rib").string();
  std::ofstream(file) << text;
  RenderSettings settings = settings_;
  settings.edits.push_back(file);
  job_ = ShotJob::open(files_, settings, stats_, log_);
  if (!job_) throw std::runtime_error("the edit cannot be applied");
  job_->prepareToShow();
  textOfJob_ = text;
  return *job_;
}

// Squares of buckets, those near the pointer first.
std::vector<PixelRect> Relighting::parts() const {
  const DeepFrame& frame = files_->dfb().shot().frame;
  const int across = kBucketsAcross * frame.bucketWidth, down = kBucketsAcross * frame.bucketHeight;
  std::vector<PixelRect> out;
  for (int y = frame.padded.y0; y < window_.y1; y += down)
    for (int x = frame.padded.x0; x < window_.x1; x += across) {
      const PixelRect part{std::max(x, window_.x0), std::max(y, window_.y0), std::min(x + across, window_.x1),
                           std::min(y + down, window_.y1)};
      if (part.width() > 0 && part.height() > 0) out.push_back(part);
    }
  return out;
}

ShownTiles Relighting::plainTiles() {
  const auto load = [this](size_t index, DeepTile& tile) {
    const auto hidden = tiles_->read(index);
    if (hidden) tile = *hidden;
    return hidden != nullptr;
  };
  return {load, [](size_t, const DeepTile&) {}};
}

void Relighting::run(const Pass& pass) {
  ShotJob& job = jobFor(pass.state);
  const Layer layer = [&] {
    const std::lock_guard lock(mutex_);
    return list_[pass.layer];
  }();
  const std::string lights = layer.lights.value_or("");
  job.choose(layer.lights ? &lights : nullptr, layer.indirect);
  const auto pixels = static_cast<size_t>(window_.width()) * static_cast<size_t>(window_.height());
  if (pass.layer == kGlow) glow_.assign(pixels, vec3(0.0f));
  // Neighbouring parts need the same buckets at their border.
  std::mutex sharing;
  std::map<size_t, std::vector<ShadedPoints>> shaded;
  const ShownTiles tiles{[&](size_t index, DeepTile& tile) {
                           if (!plainTiles().load(index, tile)) return false;
                           const std::lock_guard lock(sharing);
                           if (const auto known = shaded.find(index); known != shaded.end())
                             tile.shaded = known->second;
                           return true;
                         },
                         [&](size_t index, const DeepTile& tile) {
                           const std::lock_guard lock(sharing);
                           shaded.emplace(index, tile.shaded);
                         }};
  std::vector<PixelRect> left = parts();
  const size_t all = left.size();
  while (!left.empty() && !cancel_) {
    size_t nearest = 0;
    {
      const std::lock_guard lock(mutex_);
      const auto distance = [&](const PixelRect& p) {
        const int dx = (p.x0 + p.x1) / 2 - pointerX_, dy = (p.y0 + p.y1) / 2 - pointerY_;
        return dx * dx + dy * dy;
      };
      nearest = static_cast<size_t>(std::ranges::min_element(left, {}, distance) - left.begin());
      done_ = 1 - static_cast<float>(left.size()) / static_cast<float>(all);
    }
    job.show(
        left[nearest], tiles, [&](const Image& rows) { take(pass.layer, rows); }, cancel_);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(nearest));
  }
}

void Relighting::take(size_t layer, const Image& rows) {
  const PixelRect part{rows.originX, rows.originY, rows.originX + rows.width, rows.originY + rows.height};
  std::vector<vec3> rgb;
  for (int y = 0; y < rows.height; ++y)
    for (int x = 0; x < rows.width; ++x) rgb.push_back(colorAt(rows, x, y));
  const auto placeOf = [&](size_t i) {
    const size_t x = i % static_cast<size_t>(rows.width), y = i / static_cast<size_t>(rows.width);
    return (static_cast<size_t>(part.y0 - window_.y0) + y) * static_cast<size_t>(window_.width()) +
           static_cast<size_t>(part.x0 - window_.x0) + x;
  };
  for (size_t i = 0; i < rgb.size() && layer == kGlow; ++i) glow_[placeOf(i)] = rgb[i];
  for (size_t i = 0; i < rgb.size() && layer >= kFirstLight; ++i) rgb[i] -= glow_[placeOf(i)];
  uint32_t version = 0;
  {
    const std::lock_guard lock(mutex_);
    version = list_[layer].version;
    if (layer == kWhole) {
      Image finished = rows;
      expose(finished, job_->shot().scene.options);
      runImager(finished, job_->job().shading());
      finished_.resize(static_cast<size_t>(window_.width()) * static_cast<size_t>(window_.height()));
      for (size_t i = 0; i < rgb.size(); ++i)
        finished_[placeOf(i)] = colorAt(finished, static_cast<int>(i) % rows.width, static_cast<int>(i) / rows.width);
    }
  }
  layers_->put(layer, part, rgb, version);
}

void Relighting::edit(const Json& json) {
  const EditState state = stateOf(json, editable_);
  const std::lock_guard lock(mutex_);
  present_ = state;
  wantsWhole_ = false;
  if (!running_ || isOld(list_[*running_], list_[*running_].begun)) cancel_ = true;
  changed_.notify_all();
}

EditState Relighting::present() const {
  const std::lock_guard lock(mutex_);
  return present_;
}

void Relighting::pointAt(int x, int y) {
  const std::lock_guard lock(mutex_);
  pointerX_ = window_.x0 + x;
  pointerY_ = window_.y0 + y;
}

void Relighting::askForWhole() {
  const std::lock_guard lock(mutex_);
  wantsWhole_ = true;
  changed_.notify_all();
}

std::vector<float> Relighting::whole() const {
  const std::lock_guard lock(mutex_);
  std::vector<float> out;
  const std::optional<EditState>& shaded = list_[kWhole].shaded;
  if (!shaded || !(*shaded == present_)) return out;
  for (const vec3& c : finished_) out.insert(out.end(), {c.x, c.y, c.z});
  return out;
}

}  // namespace tomales
