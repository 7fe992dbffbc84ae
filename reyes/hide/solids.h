// Private to the hider: solids (SolidBegin ... SolidEnd). All surfaces of their parts that cover a sample become the
// surface of the whole.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

/// Finds the boundaries of the solids from `samples.crossings`, and lets them compete for the samples like other
/// surfaces. Call it after the last grid; before that a solid hides nothing.
void resolveSolids(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples);

}  // namespace tomales
