// Private to the hider: samples that transparent neighbours would show twice, because pieces reach over the borders
// that they share (docs/decisions/0003).
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

/// Returns the difference between the depth keys of one of a layer's cells.
float depthRangeOfCell(const TransparentLayers& layers, const GridTable& grids, size_t layer);
/// Samples of two layers that their cells cover only by reaching beyond a border, where the other layer covers them as
/// well.
struct BorderOverlap {
  uint64_t first = 0, second = 0;
};
/// The result depends on what the samples see of the two, not on how cells came to share layers. Pre: both have the
/// same TransparentLayer::object. Layers that move or are out of focus have no such samples, nor have those of solids,
/// which count a crossing once.
BorderOverlap borderOverlap(const SampleBuffer& samples, const GridTable& grids, const Camera& camera, size_t layer,
                            size_t other);

}  // namespace tomales
