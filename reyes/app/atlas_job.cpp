#include "reyes/app/atlas_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "reyes/base/temporary_folder.h"
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

bool asksPoints(const RenderSettings& settings, const Scene& scene) {
  if (settings.gi != GiChoice::Scene) return settings.gi == GiChoice::Points;
  const Param* radiance = indirectParam(scene, "radiance");
  return radiance && !radiance->strings.empty() && radiance->strings[0] == "points";
}

/// Brick maps, so that a ray finds the mean over its footprint, of those point clouds that are there.
void bricksOfPoints(const fs::path& clouds, const fs::path& folder, const MapNames& names,
                    const BrickSettings& settings, Log& log) {
  for (const std::string& name : names.ofReflectors()) {
    const fs::path points = atlasFile(clouds, name, ".ptc");
    if (!fs::exists(points)) {
      log.report(Severity::Missing, "points-none-" + name, {},
                 fmt::format("there are no points \"{}\": its objects reflect no indirect light", points.string()));
      continue;
    }
    const std::vector<CloudChannel> channels = PointFile(points.string()).channels();
    if (std::none_of(channels.begin(), channels.end(), [](const CloudChannel& c) { return c.name == "irradiance"; }))
      throw FileError(fmt::format("\"{}\" has no channel \"irradiance\"", points.string()));
    writeIrradianceBricks(points, atlasFile(folder, name, ".bkm"), settings);
  }
}

void warnOfStrangers(const IrradianceAtlas& maps, uint64_t world, Log& log) {
  if (const auto strange = maps.strange(world))
    log.report(
        Severity::Warning, "atlas-stale", {},
        fmt::format("irradiance map \"{}\" was made before the scene was changed, or from another; it is used as it is",
                    *strange));
}

}  // namespace

std::string atlasFolder(const RenderSettings& settings, const Scene& scene) {
  if (!settings.atlasFolder.empty()) return settings.atlasFolder;
  const Param* p = indirectParam(scene, "atlas");
  return p && !p->strings.empty() ? p->strings[0] : std::string();
}

AtlasSettings atlasSettings(const RenderSettings& settings, const Scene& scene) {
  AtlasSettings out;
  out.world = worldSum(scene);
  out.photons.emit = settings.photons;
  out.photons.seed = lightSeedOf(settings);
  out.photons.direct = settings.atlasDirect;
  out.bricks.maxError = settings.brickMaxError;
  const Param* bounces = indirectParam(scene, "bounces");
  if (bounces) out.photons.maxDepth = std::max(1, static_cast<int>(bounces->number(10)));
  if (settings.bounces > 0) out.photons.maxDepth = settings.bounces;
  return out;
}

bool storesDirect(const RenderSettings& settings, const Scene& scene) {
  const std::string folder = atlasFolder(settings, scene);
  if (asksPoints(settings, scene)) return true;
  return !folder.empty() && isMadeByHand(folder) ? holdsDirect(folder) : settings.atlasDirect;
}

std::unique_ptr<const IrradianceAtlas> prepareAtlas(const Scene& scene, const RayScene& rays,
                                                    const ShadingSystem& shading, const RenderSettings& settings,
                                                    Stats& stats, Log& log) {
  const AtlasSettings atlas = atlasSettings(settings, scene);
  const std::string given = atlasFolder(settings, scene);
  const bool points = asksPoints(settings, scene);
  if (points && given.empty()) {
    log.report(Severity::Missing, "points-folder", {},
               "--gi points needs --atlas FOLDER of point clouds with irradiance: rendered without indirect light");
    return nullptr;
  }
  std::optional<TemporaryFolder> temporary;  // an open map keeps its file readable
  try {
    if (given.empty() || points) temporary.emplace(fs::temp_directory_path());
    const fs::path folder = temporary ? temporary->path() : fs::path(given);
    const MapNames names = mapNames(scene, atlas);
    const bool byHand = points || isMadeByHand(folder);
    if (points) bricksOfPoints(given, folder, names, {.maxError = settings.brickMaxError}, log);
    if (!byHand) writeAtlas(folder, scene, rays, shading, names, atlas, {}, stats, log);
    auto maps = std::make_unique<const IrradianceAtlas>(folder, scene, names, brickCacheBytes(settings), log);
    if (byHand) warnOfStrangers(*maps, atlas.world, log);
    return maps;
  } catch (const std::runtime_error& e) {  // FileError, or of the file system
    log.report(Severity::Missing, "atlas", {}, std::string(e.what()) + ": rendered without indirect light");
    return nullptr;
  }
}

std::unique_ptr<const IrradianceAtlas> openBaked(const Scene& scene, const RenderSettings& settings, Log& log) {
  if (settings.bakedFolder.empty()) {
    log.report(Severity::Missing, "baked-folder", {},
               "--gi baked needs --baked FOLDER: rendered without indirect light");
    return nullptr;
  }
  try {
    const AtlasSettings atlas = atlasSettings(settings, scene);
    auto maps = std::make_unique<const IrradianceAtlas>(
        settings.bakedFolder, scene, mapNames(scene, atlas).ofSurfaces(), brickCacheBytes(settings), log);
    warnOfStrangers(*maps, atlas.world, log);
    return maps;
  } catch (const std::runtime_error& e) {  // FileError, or of the file system
    log.report(Severity::Missing, "baked", {}, std::string(e.what()) + ": rendered without indirect light");
    return nullptr;
  }
}

void bakeGathered(const GiServices& services, const DeepFrame& layout, const TileReader& tiles, const Scene& scene,
                  const RenderSettings& settings, Log& log) {
  try {
    const AtlasSettings atlas = atlasSettings(settings, scene);
    services.bake(layout, tiles, settings.bakedFolder, mapNames(scene, atlas).ofSurfaces(), atlas.world);
  } catch (const std::runtime_error& e) {
    log.report(Severity::Output, "baked-write", {}, std::string(e.what()) + ": the gathered light is not kept");
  }
}

}  // namespace tomales
