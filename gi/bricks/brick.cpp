#include "gi/bricks/brick.h"

#include <cstring>
#include <limits>

namespace tomales {
namespace {

constexpr float kMostSteps = 65535;
constexpr float kShareOfTolerance = 1.0f / 16;  ///< Share of the tolerance that rounding may use.

/// The range of every channel, as its lowest value and the step of 16 bits.
struct Steps {
  std::vector<float> low, step;

  Steps(std::span<const float> data, size_t width) : low(width, 0.0f), step(width, 0.0f) {
    if (data.empty()) return;
    const bool finite = std::all_of(data.begin(), data.end(), [](float v) { return std::isfinite(v); });
    for (size_t k = 0; k < width; ++k) {
      float least = data[k], most = data[k];
      for (size_t i = k; i < data.size(); i += width) {
        least = std::min(least, data[i]);
        most = std::max(most, data[i]);
      }
      low[k] = least;
      step[k] = finite ? (most - least) / kMostSteps : kInfinity;
    }
  }
  bool suffice(float tolerance) const {
    return std::all_of(step.begin(), step.end(), [&](float s) { return 0.5f * s <= kShareOfTolerance * tolerance; });
  }
  std::vector<uint16_t> of(std::span<const float> data) const {
    std::vector<uint16_t> out(data.size());
    for (size_t k = 0; k < step.size(); ++k) {
      if (!(step[k] > 0)) continue;
      for (size_t i = k; i < data.size(); i += step.size()) out[i] = nearest((data[i] - low[k]) / step[k]);
    }
    return out;
  }

 private:
  static uint16_t nearest(float steps) {
    const float t = std::min(steps, kMostSteps);
    const auto below = static_cast<int>(t);
    return static_cast<uint16_t>(below + (t - static_cast<float>(below) >= 0.5f));  // std::round() is a call
  }
};

template <class T>
void append(std::vector<std::byte>& bytes, const T* values, size_t count) {
  const auto* from = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(T));
}

}  // namespace

Brick::Brick(const Parts& parts, int width, float tolerance) : width_(static_cast<size_t>(width)) {
  Head head;
  std::vector<uint16_t> first;
  first.reserve(std::min(parts.voxels.size(), size_t{kBrickVoxels}) + 1);
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
  bytes_.reserve(wholeSize());
  append(bytes_, parts.layers.data(), parts.layers.size());
  if (head.rounded) {
    append(bytes_, steps.low.data(), width_);
    append(bytes_, steps.step.data(), width_);
    const std::vector<uint16_t> rounded = steps.of(parts.data);
    append(bytes_, rounded.data(), rounded.size());
  } else {
    append(bytes_, parts.data.data(), parts.data.size());
  }
  if (head.several) append(bytes_, first.data(), first.size());
}

std::optional<Brick> Brick::of(std::vector<std::byte> bytes, int width) {
  if (bytes.size() < sizeof(Head)) return std::nullopt;
  Brick out(std::move(bytes), static_cast<size_t>(width));
  const Head& h = out.head();
  if (h.layers > std::numeric_limits<uint16_t>::max() || h.voxels > kBrickVoxels ||
      out.bytes_.size() != out.wholeSize())
    return std::nullopt;
  size_t filled = 0;
  for (size_t slab = 0; slab < h.filled.size(); ++slab) {
    if (h.before[slab] != filled) return std::nullopt;
    filled += static_cast<size_t>(std::popcount(h.filled[slab]));
  }
  if (h.voxels != filled || (!h.several && h.layers != filled)) return std::nullopt;
  if (h.several) {
    const std::span first(out.at<uint16_t>(out.firstAt()), filled + 1);
    if (first.front() != 0 || first.back() != h.layers || !std::is_sorted(first.begin(), first.end()))
      return std::nullopt;
  }
  const std::span numbers(out.at<float>(out.dataAt()), h.rounded ? 2 * out.width_ : h.layers * out.width_);
  if (!std::all_of(numbers.begin(), numbers.end(), [](float v) { return std::isfinite(v); })) return std::nullopt;
  return out;
}

}  // namespace tomales
