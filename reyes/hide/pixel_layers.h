// Front to back, sample by sample. Private to the hider.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reyes/base/simd.h"

namespace tomales {

/// All samples of a pixel, up to 64, that see one cell.
struct Sight {
  uint32_t cell, word;
  uint64_t samples;
  float d;              ///< Of the nearest of its samples.
  const float* depths;  ///< A depth key for each of the word's samples, meaningless where it is not one of these.
  float far = __builtin_inff();  ///< No less than the depth key of any of its samples.
};

class PixelLayers {
 public:
  using Nearer = std::function<bool(const Sight&, const Sight&)>;
  /// Cuts sights where surfaces pass through each other within a pixel, so that the list is nearest first for every
  /// sample: again and again the nearest sight that any sample has in front, for all samples that have it in front. Pre
  /// and post: in the order of `nearer`.
  void order(std::vector<Sight>& sights, const Nearer& nearer);

  struct Layer {
    float d;
    uint32_t sight;
  };
  /// What is left of the layers of each sample that has any, nearest first: layers[next .. end). Padded to kLanes.
  struct Queues {
    AlignedVector<float> d;         ///< Of the layer in front; infinity: none is left.
    AlignedVector<uint32_t> sight;  ///< Of the same.
    std::vector<uint32_t> next, end;
    std::vector<uint32_t> sample;  ///< 64 * word + bit
    std::vector<Layer> layers;

    void resize(size_t queues);
    void show(size_t queue) {
      const bool any = next[queue] < end[queue];
      d[queue] = any ? layers[next[queue]].d : kNone_d;
      sight[queue] = any ? layers[next[queue]].sight : kNone;
    }
  };
  static constexpr float kNone_d = __builtin_inff();
  static constexpr uint32_t kNone = ~0U;

 private:
  /// Those that lie behind all before them, sample or not, need not be looked at together with them.
  std::span<const Sight> nextRun(std::span<const Sight> sights);
  bool overlap(std::span<const Sight> sights);
  bool inOrder(std::span<const Sight> sights);
  void listLayers(std::span<const Sight> sights);

  std::vector<uint64_t> covered_;
  std::vector<float> last_;
  std::vector<uint32_t> counts_;
  Queues queues_;
  std::vector<Sight> merged_;
};

}  // namespace tomales
