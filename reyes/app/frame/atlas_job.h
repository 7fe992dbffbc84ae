// The irradiance atlas of one frame: brick maps that are there, or photons traced for them.
#pragma once
#include "gi/services.h"
#include "reyes/app/settings.h"

namespace tomales {

/// settings.atlasFolder, or that of the scene's indirect lights, below settings.outputRoot unless it is only read;
/// empty: neither. Throws WriteError.
std::string atlasFolder(const RenderSettings& settings, const ShadingSystem& shading);

AtlasSettings atlasSettings(const RenderSettings& settings, const Scene& scene, const ShadingSystem& shading);
/// Do the maps of GiMode::Atlas hold direct light? Those made by hand say so themselves.
bool storesDirect(const RenderSettings& settings, const ShadingSystem& shading);

/// In the atlasFolder(), where what is still true is used and the rest made; without
/// one in a temporary folder. Maps put there by hand are used as they are. Null after an error, which has been
/// reported.
std::unique_ptr<const IrradianceAtlas> prepareAtlas(const Scene& scene, const RayScene& rays,
                                                    const ShadingSystem& shading, const RenderSettings& settings,
                                                    const AtlasProgress& progress, Stats& stats, Log& log);

/// The light of settings.bakedFolder, for GiMode::Baked. Null after an error, which has been reported.
std::unique_ptr<const IrradianceAtlas> openBaked(const Scene& scene, const ShadingSystem& shading,
                                                 const RenderSettings& settings, Log& log);
/// What has been gathered goes to settings.bakedFolder. Errors are reported.
void bakeGathered(const GiServices& services, const DeepFrame& layout, const TileReader& tiles, const Scene& scene,
                  const ShadingSystem& shading, const RenderSettings& settings, Log& log);

}  // namespace tomales
