// The irradiance atlas of one frame: brick maps that are there, or photons traced for them.
#pragma once
#include "gi/services.h"
#include "reyes/app/settings.h"

namespace tomales {

AtlasSettings atlasSettings(const RenderSettings& settings, const Scene& scene);

/// In settings.atlasFolder, or the `atlas` of the scene's indirect light, where what is still true is used and the rest made; without
/// either in a temporary folder. Maps put there by hand are used as they are. Null after an error, which has been reported.
std::unique_ptr<const IrradianceAtlas> prepareAtlas(const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                                                    const RenderSettings& settings, Stats& stats, Log& log);

}  // namespace tomales
