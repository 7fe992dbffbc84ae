// Guesses which renderer a scene was made for.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// Tells whether the scene has options that only BMRT has ("radiosity", "render" "max_raylevel", "minshadowbias",
/// "use_hierarchy") or its attributes ("render", "radiosity"), and none of those that only PRMan has ("limits"
/// "bucketsize", "gridsize", "eyesplits"). It is false for a scene for both.
bool isMadeForBmrt(const Scene& scene);

}  // namespace tomales
