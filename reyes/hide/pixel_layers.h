// Front to back, sample by sample. Private to the hider.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace tomales {

/// All samples of a pixel, up to 64, that see one cell.
struct Sight {
  uint32_t cell, word;
  uint64_t samples;
  float d;              ///< Of the nearest of its samples.
  const float* depths;  ///< Opaque: a depth key for each of the word's 64 samples. Else one for each of `samples`.
  bool opaque;
};

class PixelLayers {
 public:
  /// Cuts sights where surfaces pass through each other within a pixel, so that the list is nearest first for every sample:
  /// again and again the nearest sight that any sample has in front, for all samples that have it in front. Pre and post:
  /// in the order of `nearer`.
  template <class Nearer>
  void order(std::vector<Sight>& sights, const Nearer& nearer) {
    if (inOrder(sights)) return;
    listLayers(sights);
    merged_.clear();
    while (takeNearest(sights, nearer)) {
    }
    sights.swap(merged_);
  }

 private:
  struct Layer {
    float d;
    uint32_t sight;
  };
  /// What is left of the layers of a sample, nearest first: layers_[next .. end).
  struct Queue {
    uint32_t next, end;
    uint32_t sample;  ///< 64 * word + bit
  };

  template <class F>
  static void forSamples(const Sight& sight, const F& f) {
    int k = 0;
    for (uint64_t left = sight.samples; left; left &= left - 1, ++k) {
      const int bit = std::countr_zero(left);
      f(size_t{sight.word} * 64 + static_cast<size_t>(bit), sight.depths[sight.opaque ? bit : k]);
    }
  }

  /// Also counts the layers of each sample.
  bool inOrder(const std::vector<Sight>& sights) {
    size_t words = 0;
    for (const Sight& s : sights) words = std::max(words, size_t{s.word} + 1);
    last_.assign(words * 64, -std::numeric_limits<float>::infinity());
    counts_.assign(words * 64, 0);
    bool ordered = true;
    for (const Sight& sight : sights)
      forSamples(sight, [&](size_t sample, float d) {
        ordered &= d >= last_[sample];
        last_[sample] = d;
        ++counts_[sample];
      });
    return ordered;
  }

  void listLayers(const std::vector<Sight>& sights) {
    queues_.clear();
    uint32_t total = 0;
    for (uint32_t sample = 0; sample < counts_.size(); ++sample) {
      if (counts_[sample] > 0) queues_.push_back({total, total, sample});
      const uint32_t count = counts_[sample];
      counts_[sample] = static_cast<uint32_t>(queues_.size()) - 1;  // From here on: its queue.
      total += count;
    }
    layers_.resize(total);
    // Nearly sorted already. Equal depths keep the order of the sights, which no schedule changes.
    for (uint32_t k = 0; k < sights.size(); ++k)
      forSamples(sights[k], [&](size_t sample, float d) {
        Queue& queue = queues_[counts_[sample]];
        uint32_t at = queue.end++;
        for (; at > queue.next && layers_[at - 1].d > d; --at) layers_[at] = layers_[at - 1];
        layers_[at] = {d, k};
      });
  }

  template <class Nearer>
  bool takeNearest(const std::vector<Sight>& sights, const Nearer& nearer) {
    Layer front{std::numeric_limits<float>::infinity(), ~0U};
    for (const Queue& q : queues_) {
      if (q.next == q.end) continue;
      const Layer& layer = layers_[q.next];
      const bool tie = layer.d == front.d && front.sight != ~0U && layer.sight != front.sight;
      if (layer.d < front.d || front.sight == ~0U || (tie && nearer(at(sights, layer), at(sights, front)))) front = layer;
    }
    if (front.sight == ~0U) return false;
    Sight taken = at(sights, front);
    taken.samples = 0;
    for (Queue& q : queues_)
      if (q.next < q.end && layers_[q.next].sight == front.sight)
        ++q.next, taken.samples |= uint64_t{1} << (q.sample % 64);
    merged_.push_back(taken);
    return true;
  }

  static Sight at(const std::vector<Sight>& sights, const Layer& layer) {
    Sight sight = sights[layer.sight];
    sight.d = layer.d;
    return sight;
  }

  std::vector<float> last_;
  std::vector<uint32_t> counts_;
  std::vector<Layer> layers_;
  std::vector<Queue> queues_;
  std::vector<Sight> merged_;
};

}  // namespace tomales
