// What transparent neighbours show twice, because pieces reach over the borders that they share (docs/decisions/0003).
// Private to the hider.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

/// How far the depth keys of one of a film's cells lie apart.
float depthOfCell(const Films& films, const GridTable& grids, size_t film);
/// Samples of two films that their cells cover by reaching beyond a border alone, where the other film is there as
/// well.
struct ShownTwice {
  uint64_t first = 0, second = 0;
};
/// It depends on what the samples see of the two, not on how cells came to share films. Pre: Film::object of both is
/// the same. Films that move or are out of focus have none; nor have those of solids, which count a crossing once.
ShownTwice shownTwice(const SampleBuffer& samples, const GridTable& grids, const Camera& camera, size_t film,
                      size_t other);

}  // namespace tomales
