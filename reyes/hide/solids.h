// Solids (SolidBegin ... SolidEnd): everything of them that covers a sample -> the surface of the whole. Private to the
// hider.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

/// Takes `samples.crossings` and lets the boundaries of the solids compete for the samples as other surfaces do. Call
/// it after the last grid: until then a solid hides nothing.
void resolveSolids(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples);

}  // namespace tomales
