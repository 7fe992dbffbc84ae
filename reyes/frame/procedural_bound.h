// Private to reyes/frame: procedurals that do not keep the bound that the scene states.
#pragma once
#include "reyes/base/log.h"
#include "reyes/scene.h"

namespace tomales {

/// Reports contents outside of the bound, which are drawn only in buckets that the bound touches. It tests points on
/// the surfaces, because boxes around them would be too large.
void checkProceduralBound(const Procedural& procedural, const Expansion& inside, Log& log);

}  // namespace tomales
