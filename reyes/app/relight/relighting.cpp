#include "reyes/app/relight/relighting.h"

namespace tomales {
namespace {

RenderSettings watchedBy(WorkStatus& status, RenderSettings settings) {
  settings.report.watcher = [&status](const char* doing, float done) { status.tell(doing, done); };
  return settings;
}

}  // namespace

Relighting::Relighting(const RenderSettings& settings, Stats& stats, Log& log)
    : file_(settings.input.files.front()), log_(log), shot_(watchedBy(status_, settings), stats, log) {}

Relighting::~Relighting() {
  if (!session_) return;
  session_->end();
  layers().wake();
  if (thread_.joinable()) thread_.join();
}

bool Relighting::prepare() {
  const auto job = shot_.open();
  if (!job) return false;
  sharesBounces_ = sharesBounces(*job);
  const PixelRect& window = job->shot().frame.crop;
  parts_ = std::make_unique<PictureParts>(job->shot().frame, window);
  EditedLayers layers(layersOf(*job, parts_->count()), shot_.editable(), shot_.takeGivenEdit());
  pictures_ = std::make_unique<LayerPictures>(window, layers.count());
  sketch_ = std::make_unique<SketchPoints>(window, parts_->count());
  shared_ = std::make_unique<SharedTiles>(layers.count());
  session_ = std::make_unique<EditSession>(std::move(layers), *parts_);
  return true;
}

void Relighting::start() {
  thread_ = std::thread([this] { work(); });
}

void Relighting::edit(const Json& json) { session_->edit(stateOf(json, editable())); }

void Relighting::pointAt(int x, int y) { session_->pointAt({parts_->window().x0 + x, parts_->window().y0 + y}); }

PixelRect Relighting::insideOfWindow(const PixelRect& p) const {
  const PixelRect& window = parts_->window();
  const auto column = [&](int x) { return window.x0 + std::clamp(x, 0, window.width()); };
  const auto row = [&](int y) { return window.y0 + std::clamp(y, 0, window.height()); };
  const PixelRect out{column(p.x0), row(p.y0), column(p.x1), row(p.y1)};
  if (out.width() < 1 || out.height() < 1) throw BadRequest("this region is outside of the picture");
  return out;
}

void Relighting::shadeOnly(const std::optional<PixelRect>& pixels) {
  session_->shadeOnly(pixels ? std::optional(insideOfWindow(*pixels)) : std::nullopt);
}

void Relighting::askForVariable(const std::string& name) {
  const std::vector<std::string> known = variablesOf(shot_.files()->dfb().shot().scene.options);
  if (!name.empty() && std::ranges::count(known, name) == 0) throw BadRequest("there is no variable of this name");
  session_->showVariable(name);
}

void Relighting::askToGather(const PixelRect& pixels) { session_->askToGather(insideOfWindow(pixels)); }

std::vector<float> Relighting::whole() const {
  std::vector<float> out;
  session_->ifShown(kWhole, [&] { out = pictures_->finished(); });
  return out;
}

}  // namespace tomales
