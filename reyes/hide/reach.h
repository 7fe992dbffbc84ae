// What transparent neighbours show twice, because pieces reach over the borders that they share (docs/decisions/0003). Private to the hider.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

/// How far the depth keys of one of a film's cells lie apart.
float depthOfCell(const Films& films, const GridTable& grids, size_t film);
/// Samples of a film that its cells cover by reaching beyond a border alone, where another film of the same surface is there as well. It depends on
/// what the samples see of the two, not on how cells came to share films. Of films that move or are out of focus: none; nor of solids, which
/// count a crossing once.
uint64_t shownTwice(const SampleBuffer& samples, const GridTable& grids, const Camera& camera, size_t film, size_t other);

}  // namespace tomales
