#include "reyes/app/watch/preview.h"

#include <chrono>

namespace tomales {
namespace {

constexpr size_t kMostWaiting_bytes = size_t{64} << 20;
constexpr std::chrono::seconds kPatience{1};  ///< Longest wait for a silent viewer, after the picture is done.
constexpr size_t kChannels = 4;               ///< R G B A, the first of a frame's picture.

DriverPicture pictureOf(const std::string& address, const std::string& name, const DeepFrame& layout) {
  Param title;
  title.name = "title";
  title.type = ValueType::String;
  title.strings = {name};
  const PixelRect& crop = layout.crop;
  return {.name = address,
          .mode = "rgba",
          .width = crop.width(),
          .height = crop.height(),
          .x = crop.x0,
          .y = crop.y0,
          .fullWidth = crop.width(),
          .fullHeight = crop.height(),
          .channels = {"R", "G", "B", "A"},
          .params = {title},
          .view = {}};
}

size_t bytesOf(const Image& rows) { return rows.pixels.size() * sizeof(float); }

}  // namespace

Preview::Preview(std::string address, const std::string& name, const DeepFrame& layout, Log& log)
    : address_(std::move(address)),
      picture_(pictureOf(address_, name, layout)),
      log_(log),
      thread_([this] { run(); }) {}

Preview::~Preview() {
  {
    std::unique_lock lock(mutex_);
    done_ = true;
    wake_.notify_all();
    if (!ended_.wait_for(lock, kPatience, [this] { return closed_; }) && driver_) driver_->abandon();
  }
  thread_.join();
}

void Preview::show(const Image& rows) {
  Image shown{rows.width, rows.height, picture_.channels, {}, rows.originX, rows.originY};
  shown.pixels.reserve(rows.pixels.size() / rows.channels.size() * kChannels);
  for (size_t i = 0; i < rows.pixels.size(); i += rows.channels.size())
    shown.pixels.insert(shown.pixels.end(), &rows.pixels[i], &rows.pixels[i] + kChannels);
  const std::lock_guard lock(mutex_);
  if (closed_ || waiting_bytes_ + bytesOf(shown) > kMostWaiting_bytes) return;
  waiting_bytes_ += bytesOf(shown);
  waiting_.push_back(std::move(shown));
  wake_.notify_all();
}

std::optional<Image> Preview::next() {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [this] { return done_ || !waiting_.empty(); });
  if (waiting_.empty()) return std::nullopt;
  Image rows = std::move(waiting_.front());
  waiting_.pop_front();
  waiting_bytes_ -= bytesOf(rows);
  return rows;
}

void Preview::run() {
  const std::string plugin = suppliedDriver("tev");
  DisplayDriver driver(plugin, picture_);
  if (driver.failed())
    log_.report(Severity::Note, "preview", {}, "--preview: " + driver.error() + "; the picture is made without");
  {
    const std::lock_guard lock(mutex_);
    driver_ = &driver;
  }
  bool open = !driver.failed();
  while (open) {
    const auto rows = next();
    if (!rows) {
      driver.close();
      break;
    }
    open = driver.write(*rows);
  }
  const std::lock_guard lock(mutex_);
  driver_ = nullptr;
  closed_ = true;
  waiting_.clear();
  ended_.notify_all();
}

}  // namespace tomales
