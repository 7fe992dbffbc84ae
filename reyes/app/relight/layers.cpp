#include "reyes/app/relight/layers.h"

#include <chrono>
#include <glm/gtc/packing.hpp>

namespace tomales {
namespace {

constexpr float kLargestHalf = 65504;
constexpr std::chrono::seconds kNewsWait{4};  ///< Longest wait for news; the page then asks again.

uint16_t halfOf(float x) {
  return glm::packHalf1x16(std::isnan(x) ? 0.0f : std::clamp(x, -kLargestHalf, kLargestHalf));
}

vec3 colorOf(const uint16_t* p) {
  return {glm::unpackHalf1x16(p[0]), glm::unpackHalf1x16(p[1]), glm::unpackHalf1x16(p[2])};
}

uint16_t* write(const vec3& rgb, uint16_t* to) {
  for (int c = 0; c < 3; ++c) *to++ = halfOf(rgb[c]);
  return to;
}

int squares(int pixels, int step) { return (pixels + step - 1) / step; }

size_t bytesOf(const PixelRect& part, int step) {
  const auto colors =
      static_cast<size_t>(squares(part.width(), step)) * static_cast<size_t>(squares(part.height(), step));
  return (kBlockHeader * sizeof(uint32_t) + 3 * sizeof(uint16_t) * colors + 3) / 4 * 4;
}

}  // namespace

LayerStore::LayerStore(const PixelRect& window, size_t layers) : window_(window), layers_(layers), coarse_(layers) {}

// Pre: the mutex is locked.
void LayerStore::add(size_t layer, const PixelRect& part, uint32_t version, bool coarse) {
  const auto inside = [&](const Block& b) {
    return b.layer == layer && b.coarse == coarse && b.part.x0 >= part.x0 && b.part.y0 >= part.y0 &&
           b.part.x1 <= part.x1 && b.part.y1 <= part.y1;
  };
  std::erase_if(blocks_, inside);
  blocks_.push_back({static_cast<uint32_t>(layer), version, part, ++serial_, coarse});
  changed_.notify_all();
}

void LayerStore::put(size_t layer, const PixelRect& part, std::span<const vec3> rgb, uint32_t version) {
  const std::lock_guard lock(mutex_);
  std::vector<uint16_t>& to = layers_[layer];
  const auto width = static_cast<size_t>(window_.width());
  to.resize(3 * width * static_cast<size_t>(window_.height()));
  size_t from = 0;
  for (int y = part.y0; y < part.y1; ++y) {
    uint16_t* row =
        to.data() + 3 * (static_cast<size_t>(y - window_.y0) * width + static_cast<size_t>(part.x0 - window_.x0));
    for (int x = part.x0; x < part.x1; ++x) row = write(rgb[from++], row);
  }
  add(layer, part, version, false);
}

void LayerStore::putCoarse(size_t layer, std::span<const vec3> rgb, uint32_t version) {
  const std::lock_guard lock(mutex_);
  std::vector<uint16_t>& to = coarse_[layer];
  to.resize(3 * rgb.size());
  uint16_t* next = to.data();
  for (const vec3& color : rgb) next = write(color, next);
  std::erase_if(blocks_, [&](const Block& b) { return b.layer == layer; });
  add(layer, window_, version, true);
}

void LayerStore::dropCoarse(size_t layer) {
  const std::lock_guard lock(mutex_);
  std::erase_if(blocks_, [&](const Block& b) { return b.layer == layer && b.coarse; });
}

void LayerStore::append(const Block& block, int step, std::string& out) const {
  const PixelRect& p = block.part;
  const int x = p.x0 - window_.x0, y = p.y0 - window_.y0, width = window_.width();
  const auto number = [](int i) { return static_cast<uint32_t>(i); };
  const uint32_t header[kBlockHeader] = {block.layer,
                                         number(x),
                                         number(y),
                                         number(p.width()),
                                         number(p.height()),
                                         block.version,
                                         number(static_cast<int>(block.serial)),
                                         number(step)};
  const size_t begin = out.size();
  out.append(reinterpret_cast<const char*>(header), sizeof header);
  const auto copy = [&](const uint16_t* from, size_t count) {
    out.append(reinterpret_cast<const char*>(from), count * sizeof(uint16_t));
  };
  const std::vector<uint16_t>& fine = layers_[block.layer];
  const auto at = [&](int column, int row) {
    return fine.data() + 3 * (static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column));
  };
  if (block.coarse) {
    copy(coarse_[block.layer].data(), coarse_[block.layer].size());
  } else if (step == 1) {
    for (int row = y; row < y + p.height(); ++row) copy(at(x, row), 3 * static_cast<size_t>(p.width()));
  } else {
    for (int row = y; row < y + p.height(); row += step)
      for (int column = x; column < x + p.width(); column += step) {
        vec3 sum(0.0f);
        const int right = std::min(column + step, x + p.width()), below = std::min(row + step, y + p.height());
        for (int b = row; b < below; ++b)
          for (int a = column; a < right; ++a) sum += colorOf(at(a, b));
        uint16_t mean[3];
        write(sum / static_cast<float>((right - column) * (below - row)), mean);
        copy(mean, 3);
      }
  }
  out.resize(begin + bytesOf(p, step));
}

std::string LayerStore::reducedAfter(uint64_t& after, size_t bytes) const {
  const std::lock_guard lock(mutex_);
  const auto first = firstAfter(after);
  const auto stepOf = [](const Block& b, int step) { return b.coarse ? kCoarseStep : step; };
  int step = 1;
  const auto all = [&] {
    size_t sum = 0;
    for (auto b = first; b != blocks_.end(); ++b) sum += bytesOf(b->part, stepOf(*b, step));
    return sum;
  };
  while (step < kCoarseStep && all() > bytes) ++step;
  std::string out;
  for (auto b = first; b != blocks_.end(); ++b) append(*b, stepOf(*b, step), out);
  if (first != blocks_.end()) after = blocks_.back().serial;
  return out;
}

std::string LayerStore::blocksAfter(uint64_t& after, size_t bytes, uint64_t last) const {
  const std::lock_guard lock(mutex_);
  std::string out;
  auto b = firstAfter(after);
  for (; b != blocks_.end() && b->serial <= last && out.size() < bytes; ++b) {
    if (!b->coarse) append(*b, 1, out);
    after = b->serial;
  }
  if (b == blocks_.end() || b->serial > last) after = last;
  return out;
}

uint64_t LayerStore::newest() const {
  const std::lock_guard lock(mutex_);
  return serial_;
}

void LayerStore::wait(uint64_t after, uint64_t told) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kNewsWait,
                    [&] { return woken_ > told || (!blocks_.empty() && blocks_.back().serial > after); });
}

void LayerStore::wake() const {
  {
    const std::lock_guard lock(mutex_);
    ++woken_;
  }
  changed_.notify_all();
}

uint64_t LayerStore::woken() const {
  const std::lock_guard lock(mutex_);
  return woken_;
}

vec3 LayerStore::at(size_t layer, int x, int y) const {
  const std::lock_guard lock(mutex_);
  if (layers_[layer].empty()) return vec3(0.0f);
  return colorOf(layers_[layer].data() +
                 3 * (static_cast<size_t>(y - window_.y0) * static_cast<size_t>(window_.width()) +
                      static_cast<size_t>(x - window_.x0)));
}

int64_t LayerStore::bytes() const {
  const std::lock_guard lock(mutex_);
  int64_t out = 0;
  for (const auto& layer : layers_) out += static_cast<int64_t>(layer.size() * sizeof(uint16_t));
  return out;
}

}  // namespace tomales
