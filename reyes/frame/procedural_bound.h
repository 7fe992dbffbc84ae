// Private to reyes/frame: procedurals that do not keep the bound that the scene states.
#pragma once
#include "reyes/base/log.h"
#include "reyes/scene.h"

namespace tomales {

/// Reports contents beyond the bound: they are drawn only in buckets that the bound touches. It looks at points of the
/// surfaces, because boxes around them are conservative.
void checkProceduralBound(const Procedural& procedural, const Expansion& inside, Log& log);

}  // namespace tomales
