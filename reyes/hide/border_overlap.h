// Private to the hider: finds samples that transparent neighbours would show twice, because pieces reach over their
// common borders (docs/decisions/0003).
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

/// Returns the difference between the depth keys of one of a layer's cells.
float depthRangeOfCell(const TransparentLayers& layers, const GridTable& grids, size_t layer);
/// For each of two layers, the samples that its cells cover only by reaching beyond a border and that the other layer
/// covers as well.
struct BorderOverlap {
  uint64_t first = 0, second = 0;
};
/// The result depends on what the samples see of the two layers, not on which cells share a layer. Pre: both have the
/// same TransparentLayer::object. Layers that move or are out of focus have no such samples. Neither have layers of
/// solids, which count a crossing once.
BorderOverlap borderOverlap(const SampleBuffer& samples, const GridTable& grids, const Camera& camera, size_t layer,
                            size_t other);

}  // namespace tomales
