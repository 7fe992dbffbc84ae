// Bakes the radiosity maps of one frame.
#pragma once
#include "gi/services.h"
#include "reyes/app/settings.h"

namespace tomales {

/// Bakes the maps. With an atlasFolder() they are brick maps there, of all that was baked for this world, and existing
/// maps are not baked again; returns null after an error, which has been reported. Without that folder they are
/// textures in memory. With a StoredLightSettings::radiosityFolder these are also written there, as a tiled MIP EXR for
/// each object and side: NAME.exr and NAME.back.exr, by Attribute "identifier" "name". Failures to write are reported.
/// Any thread may call `progress` with the progress of baking.
std::unique_ptr<const HitRadiance> prepareRadiosity(const RayTools& tools, const Camera& camera,
                                                    const RenderSettings& settings,
                                                    const std::function<void(float)>& progress, Checkpoint* kept,
                                                    Stats& stats, Log& log);

}  // namespace tomales
