#include "reyes/app/relight/layers.h"

#include <chrono>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace tomales {
namespace {

constexpr float kLargestHalf = 65504;
constexpr std::chrono::seconds kPatience{4};

uint16_t halfOf(float x) {
  return glm::packHalf1x16(std::isnan(x) ? 0.0f : std::clamp(x, -kLargestHalf, kLargestHalf));
}

void append(std::string& out, const void* data, size_t bytes) { out.append(static_cast<const char*>(data), bytes); }

}  // namespace

LayerStore::LayerStore(const PixelRect& window, size_t layers) : window_(window), layers_(layers) {}

void LayerStore::put(size_t layer, const PixelRect& part, std::span<const vec3> rgb, uint32_t version) {
  const std::lock_guard lock(mutex_);
  std::vector<uint16_t>& to = layers_[layer];
  const auto width = static_cast<size_t>(window_.width());
  to.resize(3 * width * static_cast<size_t>(window_.height()));
  size_t from = 0;
  for (int y = part.y0; y < part.y1; ++y) {
    uint16_t* row =
        to.data() + 3 * (static_cast<size_t>(y - window_.y0) * width + static_cast<size_t>(part.x0 - window_.x0));
    for (int x = part.x0; x < part.x1; ++x, ++from)
      for (int c = 0; c < 3; ++c) *row++ = halfOf(rgb[from][c]);
  }
  const auto inside = [&](const Block& b) {
    return b.layer == layer && b.part.x0 >= part.x0 && b.part.y0 >= part.y0 && b.part.x1 <= part.x1 &&
           b.part.y1 <= part.y1;
  };
  std::erase_if(blocks_, inside);
  blocks_.push_back({static_cast<uint32_t>(layer), version, part, ++serial_});
  changed_.notify_all();
}

std::string LayerStore::blocksAfter(uint64_t& after, size_t bytes) const {
  const std::lock_guard lock(mutex_);
  std::string out;
  auto block = std::ranges::upper_bound(blocks_, after, {}, &Block::serial);
  for (; block != blocks_.end() && out.size() < bytes; ++block) {
    const PixelRect& p = block->part;
    const int x = p.x0 - window_.x0, y = p.y0 - window_.y0;
    const uint32_t header[kBlockHeader] = {block->layer,
                                           static_cast<uint32_t>(x),
                                           static_cast<uint32_t>(y),
                                           static_cast<uint32_t>(p.width()),
                                           static_cast<uint32_t>(p.height()),
                                           block->version,
                                           static_cast<uint32_t>(block->serial),
                                           0};
    append(out, header, sizeof header);
    const auto width = static_cast<size_t>(window_.width());
    for (int row = y; row < y + p.height(); ++row)
      append(out, layers_[block->layer].data() + 3 * (static_cast<size_t>(row) * width + static_cast<size_t>(x)),
             sizeof(uint16_t) * 3 * static_cast<size_t>(p.width()));
    out.resize((out.size() + 3) / 4 * 4);
    after = block->serial;
  }
  return out;
}

void LayerStore::wait(uint64_t after) const {
  std::unique_lock lock(mutex_);
  if (!blocks_.empty() && blocks_.back().serial > after) return;
  changed_.wait_for(lock, kPatience);
}

void LayerStore::wake() const { changed_.notify_all(); }

vec3 LayerStore::at(size_t layer, int x, int y) const {
  const std::lock_guard lock(mutex_);
  if (layers_[layer].empty()) return vec3(0.0f);
  const uint16_t* p =
      layers_[layer].data() + 3 * (static_cast<size_t>(y - window_.y0) * static_cast<size_t>(window_.width()) +
                                   static_cast<size_t>(x - window_.x0));
  return {glm::unpackHalf1x16(p[0]), glm::unpackHalf1x16(p[1]), glm::unpackHalf1x16(p[2])};
}

int64_t LayerStore::bytes() const {
  const std::lock_guard lock(mutex_);
  int64_t out = 0;
  for (const auto& layer : layers_) out += static_cast<int64_t>(layer.size() * sizeof(uint16_t));
  return out;
}

}  // namespace tomales
