// Private to the hider: solids (SolidBegin ... SolidEnd). All surfaces of their parts that cover a sample become the
// surface of the whole.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

/// Takes `samples.crossings` and lets the boundaries of the solids compete for the samples like other surfaces. Call it
/// after the last grid: until then a solid hides nothing.
void resolveSolids(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples);

}  // namespace tomales
