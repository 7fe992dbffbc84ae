// Private to gi: occlusion() and indirectdiffuse() of shaders from irradiance caches. Space: current.
#pragma once
#include "gi/frame/state.h"
#include "reyes/base/stop.h"

namespace tomales {

/// Runs the shaders of each group that asksHemispheres() at a few of its visible points, to learn what they ask.
void learnHemisphereQueries(GiState&, const DeepFrame& layout, const TileReader&, StopToken stop);

/// Returns the settings of the records that answer a question from points of this group.
CacheKey cacheKeyFor(const GiState&, int group, const HemisphereQuery&);

/// Implements ShadeServices::interpolatedHemisphere().
bool interpolateHemisphere(const GiState&, const AskedPoints&, const HemisphereQuery&, const ShadeContext&, TmVec3 out);

}  // namespace tomales
