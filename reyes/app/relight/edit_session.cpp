#include "reyes/app/relight/edit_session.h"

namespace tomales {
namespace {

/// Tells whether the surfaces on which light adds up may differ between the two edits. Parameters of a light change
/// incident light, and not how a surface reflects it.
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

ivec2 middleOf(const PixelRect& window) { return {window.x0 + window.width() / 2, window.y0 + window.height() / 2}; }

}  // namespace

EditSession::EditSession(EditedLayers layers, const PictureParts& parts)
    : parts_(parts), layers_(std::move(layers)), order_{.pointedAt = middleOf(parts.window())} {}

// Pre: the mutex is locked, as for the next one.
void EditSession::tellThread() {
  ++timesAsked_;
  asked_.notify_all();
}

void EditSession::stopIfUseless() {
  if (running_ && !order_.isWanted(*running_, layers_)) stop_ = true;
}

void EditSession::edit(const EditState& state) {
  const std::lock_guard lock(mutex_);
  if (mayBeLinearElsewhere(state, layers_.present())) order_.isChecked = false;
  order_.wantsWhole = false;
  layers_.edit(state);
  stopIfUseless();
  tellThread();
}

EditState EditSession::present() const {
  const std::lock_guard lock(mutex_);
  return layers_.present();
}

void EditSession::showVariable(const std::string& name) {
  const std::lock_guard lock(mutex_);
  layers_.showVariable(name);
  stopIfUseless();
  tellThread();
}

void EditSession::pointAt(const ivec2& pixel) {
  const std::lock_guard lock(mutex_);
  order_.pointedAt = pixel;
}

void EditSession::shadeOnly(const std::optional<PixelRect>& pixels) {
  const std::lock_guard lock(mutex_);
  order_.only = pixels;
  tellThread();
}

void EditSession::askForWhole() {
  const std::lock_guard lock(mutex_);
  order_.wantsWhole = true;
  tellThread();
}

void EditSession::askToGather(const PixelRect& pixels) {
  const std::lock_guard lock(mutex_);
  order_.toGather = pixels;
  tellThread();
}

bool EditSession::isGathering() const {
  const std::lock_guard lock(mutex_);
  return order_.toGather.has_value();
}

std::string EditSession::gatheredFile() const {
  const std::lock_guard lock(mutex_);
  return gatheredFile_;
}

Json EditSession::layers() const {
  const std::lock_guard lock(mutex_);
  Json out = Json::array();
  for (size_t i = 0; i < layers_.variableLayer(); ++i)
    out.push_back({{"name", layers_[i].name}, {"lights", layers_[i].handles}});
  return out;
}

Json EditSession::status() const {
  const std::lock_guard lock(mutex_);
  const size_t variable = layers_.variableLayer();
  Json layers = Json::array(), gathered = Json::array();
  for (size_t i = 0; i < variable; ++i) {
    const LayerParts& parts = layers_[i].parts;
    const vec3 unit = layers_.unitOf(i);
    layers.push_back({{"version", parts.wanted()},
                      {"unit", {unit.x, unit.y, unit.z}},
                      {"old", parts.areOld()},
                      {"left", parts.shareOld()}});
  }
  for (const PixelRect& r : gathered_) gathered.push_back(Json::array({r.x0, r.y0, r.x1, r.y1}));
  return {{"present", jsonOf(layers_.present())},
          {"imager", !layers_.present().shaders[kImagers].empty()},
          {"layers", layers},
          {"variable",
           {{"name", layers_.variable()},
            {"version", layers_[variable].parts.wanted()},
            {"left", layers_[variable].parts.shareOld()}}},
          {"notLinear", notLinear_},
          {"stale", stale_},
          {"gathered", gathered},
          {"gathering", order_.toGather.has_value()},
          {"checked", order_.isChecked}};
}

void EditSession::ifShown(size_t layer, const std::function<void()>& use) const {
  const std::lock_guard lock(mutex_);
  if (!layers_[layer].parts.areOld()) use();
}

std::optional<WorkStep> EditSession::begin() {
  const std::lock_guard lock(mutex_);
  timesSeen_ = timesAsked_;
  if (ended_) return std::nullopt;
  running_ = order_.next(layers_, parts_);
  stop_ = false;
  return running_;
}

bool EditSession::finish() {
  const std::lock_guard lock(mutex_);
  const WorkStep step = *running_;
  running_.reset();
  if (stop_) return false;
  order_.finish(step, layers_);
  return step.kind == WorkStep::Part && !layers_[step.layer].parts.areOld();
}

void EditSession::wait() {
  std::unique_lock lock(mutex_);
  asked_.wait(lock, [&] { return ended_ || timesAsked_ != timesSeen_; });
}

bool EditSession::isRehearsed() const {
  const std::lock_guard lock(mutex_);
  return order_.isRehearsed;
}

RelitLayer EditSession::layer(size_t layer) const {
  const std::lock_guard lock(mutex_);
  return layers_[layer];
}

void EditSession::setStale(std::vector<std::string> names) {
  const std::lock_guard lock(mutex_);
  stale_ = std::move(names);
}

void EditSession::setNotLinear(std::vector<std::string> names) {
  const std::lock_guard lock(mutex_);
  if (!stop_) notLinear_ = std::move(names);
}

void EditSession::takeCoarse(size_t layer, const std::function<void()>& show) {
  const std::lock_guard lock(mutex_);
  if (stop_) return;
  layers_[layer].parts.forgetAll();
  show();
}

void EditSession::takeGathered(const std::string& file, const PixelRect& p) {
  const PixelRect& window = parts_.window();
  const std::lock_guard lock(mutex_);
  gatheredFile_ = file;
  gathered_.push_back({p.x0 - window.x0, p.y0 - window.y0, p.x1 - window.x0, p.y1 - window.y0});
  for (RelitLayer& layer : layers_) layer.parts.forgetAll();
}

void EditSession::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  stop_ = true;
  tellThread();
}

bool EditSession::hasEnded() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

}  // namespace tomales
