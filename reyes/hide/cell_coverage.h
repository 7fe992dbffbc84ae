// Private to the hider: turns the cells that samples see into one coverage for each visible cell.
#pragma once
#include <span>

#include "reyes/hide/pixel_layers.h"
#include "reyes/hide/samples.h"

namespace tomales {

/// Appends the opaque cells that the samples of a pixel see.
void collectOpaque(const SampleBuffer& samples, size_t pixel, std::vector<CellCoverage>& coverages);

/// The samples among the first 64 of a pixel that see one cell. No two coverages of a pixel share a sample.
struct RankedCoverage {
  uint64_t samples;
  uint32_t cell;
  float d;
};
constexpr int kMostRanked = kLanes;
/// Coverages, nearest first. `count` is negative if samples see more than kMostRanked cells, or some at equal depths.
struct RankedCoverages {
  int count;
  RankedCoverage coverages[kMostRanked];
};
constexpr size_t kRankedTogether = 32;
/// Finds the opaque cells that the samples of some pixels see. Pre: no more than kRankedTogether pixels.
void rankOpaque(const SampleBuffer& samples, std::span<const uint32_t> pixels, RankedCoverages* out);
/// Does the same for a transparent layer.
void rankLayer(const TransparentLayers& layers, size_t layer, RankedCoverages& out);

/// The least and greatest depth keys of a transparent layer.
struct LayerExtent {
  float nearest, farthest;
};
/// Removes the hidden samples from a transparent layer. Pre: it covers some sample; afterwards it may cover none.
LayerExtent cullLayer(SampleBuffer& samples, const GridTable& grids, size_t layer);
/// Appends the cells of a transparent layer that the samples see. farthest: the layer's greatest depth key.
void collectLayer(const TransparentLayers& layers, size_t layer, float farthest, std::vector<CellCoverage>& coverages);

}  // namespace tomales
