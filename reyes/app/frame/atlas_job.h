// The irradiance atlas of one frame: existing brick maps, or photons traced for them.
#pragma once
#include "gi/services.h"
#include "reyes/app/settings.h"

namespace tomales {

/// Returns StoredLightSettings::atlasFolder, or that of the scene's indirect lights, below PictureSettings::outputRoot
/// unless it is only read; empty if neither is set. Throws WriteError.
std::string atlasFolder(const RenderSettings& settings, const ShadingSystem& shading);

AtlasSettings atlasSettings(const RenderSettings& settings, const Scene& scene, const ShadingSystem& shading);
/// Tells whether the maps of GiMode::Atlas hold direct light. Maps that were made by hand say so themselves.
bool storesDirect(const RenderSettings& settings, const ShadingSystem& shading);

/// Prepares the atlas in the atlasFolder(), where maps that are still true are used and the rest made, or else in a
/// temporary folder. Maps that were put there by hand are used as they are. Returns null after an error, which has been
/// reported.
std::unique_ptr<const IrradianceAtlas> prepareAtlas(const RayTools& tools, const RenderSettings& settings,
                                                    const AtlasProgress& progress, Checkpoint* kept, Stats& stats,
                                                    Log& log);

/// The pass that one of several processes does for the atlas that they make together.
enum class AtlasPass {
  Photons,  ///< Traces a part of the photons to a file of its own.
  Join,     ///< Makes photon maps of all parts.
  Maps,     ///< Makes irradiance and brick maps of some of the photon maps.
};
/// Does a pass in atlasFolder(), which must not be empty. It does nothing if the maps there were made by hand. All
/// passes together make what prepareAtlas() would make. part.count of Join is the number of parts. Throws FileError.
void makeAtlasPass(AtlasPass pass, WorkPart part, const RayTools& tools, const RenderSettings& settings,
                   const AtlasProgress& progress, Stats& stats, Log& log);
/// Returns the file of a part of the photons.
std::filesystem::path photonPart(const std::filesystem::path& atlas, WorkPart part);

/// Opens the light of StoredLightSettings::bakedFolder, for GiMode::Baked. Returns null after an error, which has been
/// reported.
std::unique_ptr<const IrradianceAtlas> openBaked(const Scene& scene, const ShadingSystem& shading,
                                                 const RenderSettings& settings, Log& log);
/// Writes the light that has been gathered to StoredLightSettings::bakedFolder. Errors are reported.
void bakeGathered(const GiServices& services, const DeepFrame& layout, const TileReader& tiles, const Scene& scene,
                  const ShadingSystem& shading, const RenderSettings& settings, Log& log);

}  // namespace tomales
