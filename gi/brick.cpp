#include "gi/brick.h"

#include <cstring>
#include <limits>

namespace tomales {
namespace {

constexpr float kMostSteps = 65535;
constexpr float kShareOfTolerance = 1.0f / 16;  ///< That rounding may take of it.

/// The range of every channel, as its lowest value and the step of 16 bits.
struct Steps {
  std::vector<float> low, step;

  Steps(std::span<const float> data, size_t width) : low(width, kInfinity), step(width, 0.0f) {
    std::vector<float> high(width, -kInfinity);
    for (size_t i = 0; i < data.size(); i += width)
      for (size_t k = 0; k < width; ++k) low[k] = std::min(low[k], data[i + k]), high[k] = std::max(high[k], data[i + k]);
    const bool finite = std::all_of(data.begin(), data.end(), [](float v) { return std::isfinite(v); });
    for (size_t k = 0; k < width; ++k) step[k] = finite ? (high[k] - low[k]) / kMostSteps : kInfinity;
    if (data.empty()) low.assign(width, 0.0f), step.assign(width, 0.0f);
  }
  bool suffice(float tolerance) const {
    return std::all_of(step.begin(), step.end(), [&](float s) { return 0.5f * s <= kShareOfTolerance * tolerance; });
  }
  uint16_t of(float value, size_t k) const {
    return step[k] > 0 ? static_cast<uint16_t>(std::clamp(std::round((value - low[k]) / step[k]), 0.0f, kMostSteps)) : uint16_t{0};
  }
};

template <class T>
void append(std::vector<std::byte>& bytes, const T* values, size_t count) {
  const auto* from = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(T));
}

}  // namespace

BrickLayer::BrickLayer(const vec3& n, bool isIncoherent, int of) : incoherent(isIncoherent), surface(static_cast<uint8_t>(of & kMostSurfaces)) {
  const auto part = [](float v) { return static_cast<int8_t>(std::lround(127 * std::clamp(v, -1.0f, 1.0f))); };
  x = part(n.x), y = part(n.y), z = part(n.z);
}

Brick::Brick(const Parts& parts, int width, float tolerance) : width_(static_cast<size_t>(width)) {
  Head head;
  std::vector<uint16_t> first;
  for (size_t i = 0; i < parts.voxels.size(); ++i) {
    const uint16_t v = parts.voxels[i];
    if (i > 0 && parts.voxels[i - 1] == v) continue;
    first.push_back(static_cast<uint16_t>(i));
    head.filled[v / 64u] |= uint64_t{1} << v % 64u;
  }
  for (size_t slab = 1; slab < head.filled.size(); ++slab)
    head.before[slab] = static_cast<uint16_t>(head.before[slab - 1] + std::popcount(head.filled[slab - 1]));
  head.layers = static_cast<uint32_t>(parts.layers.size());
  head.voxels = static_cast<uint16_t>(first.size());
  head.several = head.layers != head.voxels;
  first.push_back(static_cast<uint16_t>(head.layers));
  const Steps steps(parts.data, width_);
  head.rounded = steps.suffice(tolerance);

  append(bytes_, &head, 1);
  append(bytes_, parts.layers.data(), parts.layers.size());
  if (head.rounded) {
    append(bytes_, steps.low.data(), width_);
    append(bytes_, steps.step.data(), width_);
    std::vector<uint16_t> rounded(parts.data.size());
    for (size_t i = 0; i < rounded.size(); ++i) rounded[i] = steps.of(parts.data[i], i % width_);
    append(bytes_, rounded.data(), rounded.size());
  } else {
    append(bytes_, parts.data.data(), parts.data.size());
  }
  if (head.several) append(bytes_, first.data(), first.size());
  bytes_.shrink_to_fit();
}

std::optional<Brick> Brick::of(std::vector<std::byte> bytes, int width) {
  if (bytes.size() < sizeof(Head)) return std::nullopt;
  Brick out(std::move(bytes), static_cast<size_t>(width));
  const Head& h = out.head();
  if (h.layers > std::numeric_limits<uint16_t>::max() || h.voxels > kBrickVoxels || out.bytes_.size() != out.wholeSize()) return std::nullopt;
  size_t filled = 0;
  for (size_t slab = 0; slab < h.filled.size(); ++slab) {
    if (h.before[slab] != filled) return std::nullopt;
    filled += static_cast<size_t>(std::popcount(h.filled[slab]));
  }
  if (h.voxels != filled || (!h.several && h.layers != filled)) return std::nullopt;
  if (h.several) {
    const std::span first(out.at<uint16_t>(out.firstAt()), filled + 1);
    if (first.front() != 0 || first.back() != h.layers || !std::is_sorted(first.begin(), first.end())) return std::nullopt;
  }
  const std::span numbers(out.at<float>(out.dataAt()), h.rounded ? 2 * out.width_ : h.layers * out.width_);
  if (!std::all_of(numbers.begin(), numbers.end(), [](float v) { return std::isfinite(v); })) return std::nullopt;
  return out;
}

}  // namespace tomales
