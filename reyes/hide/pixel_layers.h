// Private to the hider: sorts what the samples of a pixel see from front to back, sample by sample.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reyes/base/simd.h"

namespace tomales {

/// The samples of a pixel, up to 64, that see one cell.
struct CellCoverage {
  uint32_t cell, word;
  uint64_t samples;
  float d;                       ///< Depth key of the nearest of its samples.
  const float* depths;           ///< A depth key for each sample of the word; only those of `samples` have a meaning.
  float far = __builtin_inff();  ///< Upper bound of the depth keys of its samples.
};

class PixelLayers {
 public:
  using Nearer = std::function<bool(const CellCoverage&, const CellCoverage&)>;
  /// Splits coverages where surfaces pass through each other within a pixel, so that the list is nearest first for
  /// every sample. It repeatedly takes the nearest coverage that is in front for any sample, with all samples for which
  /// it is in front. Pre and post: the list is in the order of `nearer`.
  void order(std::vector<CellCoverage>& coverages, const Nearer& nearer);

  struct Layer {
    float d;
    uint32_t coverage;
  };
  /// The remaining layers of each sample that has any, nearest first: layers[next .. end). Padded to kLanes.
  struct Queues {
    AlignedVector<float> d;            ///< Depth key of the layer in front; infinity if none is left.
    AlignedVector<uint32_t> coverage;  ///< Index of its coverage.
    std::vector<uint32_t> next, end;
    std::vector<uint32_t> sample;  ///< 64 * word + bit
    std::vector<Layer> layers;

    void resize(size_t queues);
    void show(size_t queue) {
      const bool any = next[queue] < end[queue];
      d[queue] = any ? layers[next[queue]].d : kNone_d;
      coverage[queue] = any ? layers[next[queue]].coverage : kNone;
    }
  };
  static constexpr float kNone_d = __builtin_inff();
  static constexpr uint32_t kNone = ~0U;

 private:
  /// Returns the first run of coverages that overlap in depth. All others lie behind it, and are sorted apart from it.
  std::span<const CellCoverage> nextRun(std::span<const CellCoverage> coverages);
  bool overlap(std::span<const CellCoverage> coverages);
  bool inOrder(std::span<const CellCoverage> coverages);
  void listLayers(std::span<const CellCoverage> coverages);

  std::vector<uint64_t> covered_;
  std::vector<float> last_;
  std::vector<uint32_t> counts_;
  Queues queues_;
  std::vector<CellCoverage> merged_;
};

}  // namespace tomales
