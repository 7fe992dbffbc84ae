// Guesses which renderer a scene was made for.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// Has the scene options that only BMRT has ("radiosity", "render" "max_raylevel", "minshadowbias", "use_hierarchy") or
/// its attributes ("render", "radiosity"), and none of those that only PRMan has ("limits" "bucketsize", "gridsize",
/// "eyesplits")? A scene for both says nothing.
bool isMadeForBmrt(const Scene& scene);

/// The word that an option of that name has. Empty if neither the scene nor the command line gives one.
std::string wordOf(const Options& options, const std::string& key);

}  // namespace tomales
