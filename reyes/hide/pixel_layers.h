// Front to back, sample by sample. Private to the hider.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace tomales {

/// All samples of a pixel, up to 64, that see one cell.
struct Sight {
  uint32_t cell, word;
  uint64_t samples;
  float d;              ///< Of the nearest of its samples.
  const float* depths;  ///< Opaque: a depth key for each of the word's 64 samples. Else one for each of `samples`.
  bool opaque;

  float depthOf(int sample) const {
    return depths[opaque ? sample : std::popcount(samples & ((uint64_t{1} << sample) - 1))];
  }
};

class PixelLayers {
 public:
  /// Cuts sights where surfaces pass through each other within a pixel, so that the list is nearest first for every sample:
  /// again and again the nearest sight that any sample has in front, for all samples that have it in front. Pre and post:
  /// in the order of `nearer`.
  template <class Nearer>
  void order(std::vector<Sight>& sights, const Nearer& nearer) {
    if (inOrder(sights)) return;
    lists_.assign(words_ * 64, {});
    next_.assign(words_ * 64, 0);
    for (uint32_t k = 0; k < sights.size(); ++k)
      for (uint64_t left = sights[k].samples; left; left &= left - 1) {
        const int s = std::countr_zero(left);
        lists_[sights[k].word * 64 + static_cast<size_t>(s)].push_back({sights[k].depthOf(s), k});
      }
    for (auto& list : lists_)
      // Equal depths keep the order of the sights, which no schedule changes.
      std::stable_sort(list.begin(), list.end(), [](const Layer& a, const Layer& b) { return a.d < b.d; });
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

  bool inOrder(const std::vector<Sight>& sights) {
    words_ = 0;
    for (const Sight& s : sights) words_ = std::max(words_, size_t{s.word} + 1);
    last_.assign(words_ * 64, -std::numeric_limits<float>::infinity());
    for (const Sight& sight : sights) {
      float* last = last_.data() + size_t{sight.word} * 64;
      int k = 0;
      for (uint64_t left = sight.samples; left; left &= left - 1, ++k) {
        const int s = std::countr_zero(left);
        const float d = sight.depths[sight.opaque ? s : k];
        if (d < last[s]) return false;
        last[s] = d;
      }
    }
    return true;
  }

  template <class Nearer>
  bool takeNearest(const std::vector<Sight>& sights, const Nearer& nearer) {
    Sight best{};
    uint32_t bestSight = 0;
    bool found = false;
    for (size_t lane = 0; lane < lists_.size(); ++lane) {
      if (next_[lane] == lists_[lane].size()) continue;
      const Layer& layer = lists_[lane][next_[lane]];
      Sight sight = sights[layer.sight];
      sight.d = layer.d;
      if (!found || nearer(sight, best)) best = sight, bestSight = layer.sight, found = true;
    }
    if (!found) return false;
    best.samples = 0;
    for (size_t lane = size_t{best.word} * 64; lane < size_t{best.word} * 64 + 64; ++lane)
      if (next_[lane] < lists_[lane].size() && lists_[lane][next_[lane]].sight == bestSight)
        ++next_[lane], best.samples |= uint64_t{1} << (lane % 64);
    merged_.push_back(best);
    return true;
  }

  size_t words_ = 0;
  std::vector<float> last_;
  std::vector<std::vector<Layer>> lists_;  ///< A sample
  std::vector<size_t> next_;
  std::vector<Sight> merged_;
};

}  // namespace tomales
