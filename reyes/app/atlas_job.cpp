#include "reyes/app/atlas_job.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "reyes/world_sum.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// What the scene's indirect light says; empty where nothing.
const Param* indirectParam(const Scene& scene, const char* name) {
  for (const auto& light : scene.lights)
    if (light->shader.name == "indirectlight")
      if (const Param* p = findParam(light->shader.params, name)) return p;
  return nullptr;
}

std::string folderOf(const RenderSettings& settings, const Scene& scene) {
  if (!settings.atlasFolder.empty()) return settings.atlasFolder;
  const Param* p = indirectParam(scene, "atlas");
  return p && !p->strings.empty() ? p->strings[0] : std::string();
}

/// Gone with everything in it at the end. An open map keeps its file readable.
struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("tomales_atlas_" + std::to_string(::getpid()));
  ~TemporaryFolder() {
    std::error_code error;
    fs::remove_all(path, error);
  }
};

}  // namespace

AtlasSettings atlasSettings(const RenderSettings& settings, const Scene& scene) {
  AtlasSettings out;
  out.world = worldSum(scene);
  out.photons.emit = settings.photons;
  out.photons.seed = lightSeedOf(settings);
  const Param* bounces = indirectParam(scene, "bounces");
  if (bounces) out.photons.maxDepth = std::max(1, static_cast<int>(bounces->number(10)));
  if (settings.bounces > 0) out.photons.maxDepth = settings.bounces;
  return out;
}

std::unique_ptr<const IrradianceAtlas> prepareAtlas(const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                                                    const RenderSettings& settings, Stats& stats, Log& log) {
  const AtlasSettings atlas = atlasSettings(settings, scene);
  const TemporaryFolder temporary;
  const std::string given = folderOf(settings, scene);
  const fs::path folder = given.empty() ? temporary.path : fs::path(given);
  try {
    const MapNames names = mapNames(scene, atlas);
    const bool byHand = isMadeByHand(folder);
    if (!byHand) writeAtlas(folder, scene, rays, shading, names, atlas, {}, stats, log);
    auto maps = std::make_unique<const IrradianceAtlas>(folder, scene, names, brickCacheBytes(settings), log);
    if (const auto strange = byHand ? maps->strange(atlas.world) : std::nullopt)
      log.report(Severity::Warning, "atlas-stale", {},
                 fmt::format("irradiance map \"{}\" was made before the scene was changed, or from another; it is used as it is", *strange));
    return maps;
  } catch (const FileError& e) {
    log.report(Severity::Missing, "atlas", {}, std::string(e.what()) + ": rendered without indirect light");
    return nullptr;
  }
}

}  // namespace tomales
