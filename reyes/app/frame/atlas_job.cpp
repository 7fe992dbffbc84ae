#include "reyes/app/frame/atlas_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "reyes/app/exit_code.h"
#include "reyes/app/frame/light_sources.h"
#include "reyes/base/folder_lock.h"
#include "reyes/base/output_root.h"
#include "reyes/base/stop.h"
#include "reyes/base/temporary_folder.h"
#include "reyes/base/unfinished_folder.h"
#include "reyes/world_sum.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

bool asksPoints(const RenderSettings& settings, const ShadingSystem& shading) {
  return methodOf(settings, shading).byPointClouds;
}

/// Makes brick maps of those point clouds that exist, so that a ray finds the mean over its footprint.
void bricksOfPoints(const fs::path& clouds, const fs::path& folder, const MapNames& names,
                    const BrickSettings& settings, Log& log) {
  for (const std::string& name : names.surfaceMaps()) {
    const fs::path points = atlasFile(clouds, name, ".ptc");
    if (!fs::exists(points)) {
      log.report(Severity::Missing, "points-none", {},
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
  if (const auto strange = maps.mapOfOtherWorld(world))
    log.report(
        Severity::Warning, "atlas-stale", {},
        fmt::format("irradiance map \"{}\" was made before the scene was changed, or from another; it is used as it is",
                    *strange));
}

}  // namespace

std::string atlasFolder(const RenderSettings& settings, const ShadingSystem& shading) {
  if (!settings.stored.atlasFolder.empty()) return settings.stored.atlasFolder;
  const std::string named = shading.indirectRequest().value_or(IndirectRequest{}).atlas;
  const bool onlyRead = named.empty() || asksPoints(settings, shading) || isMadeByHand(named);
  return onlyRead ? named : placeBelow(settings.picture.outputRoot, named);
}

AtlasSettings atlasSettings(const RenderSettings& settings, const Scene& scene, const ShadingSystem& shading) {
  AtlasSettings out;
  out.world = worldSum(scene);
  out.photons.emit = settings.light.photons;
  out.photons.seed = lightSeedOf(settings);
  out.photons.direct = settings.stored.atlasDirect;
  out.bricks.maxError = settings.stored.brickMaxError;
  std::optional<int> bounces = shading.indirectRequest().value_or(IndirectRequest{}).bounces;
  if (settings.light.bounces > 0) bounces = settings.light.bounces;
  if (bounces) out.photons.mostBounces = std::max(1, *bounces) - 1;  // gather rays are the last one
  return out;
}

bool storesDirect(const RenderSettings& settings, const ShadingSystem& shading) {
  const std::string folder = atlasFolder(settings, shading);
  if (asksPoints(settings, shading)) return true;
  return !folder.empty() && isMadeByHand(folder) ? holdsDirect(folder) : settings.stored.atlasDirect;
}

std::unique_ptr<const IrradianceAtlas> prepareAtlas(const RayTools& tools, const RenderSettings& settings,
                                                    const AtlasProgress& progress, Checkpoint* kept, Stats& stats,
                                                    Log& log) {
  const ShadingSystem& shading = *tools.shading;
  const Scene& scene = tools.rays->scene();
  const AtlasSettings atlas = atlasSettings(settings, scene, shading);
  const std::string given = atlasFolder(settings, shading);
  const bool points = asksPoints(settings, shading);
  if (points && given.empty()) {
    log.report(Severity::Missing, "points-folder", {},
               "--gi points needs --atlas FOLDER of point clouds with irradiance: rendered without indirect light");
    return nullptr;
  }
  std::optional<TemporaryFolder> temporary;  // an open map keeps its file readable
  try {
    if (points || (given.empty() && !kept)) temporary.emplace(fs::temp_directory_path());
    const fs::path folder = temporary ? temporary->path() : given.empty() ? kept->folder() : fs::path(given);
    const MapNames names = mapNames(scene, shading, atlas);
    makeAtlasFolder(folder);
    std::optional<FolderLock> lock;
    if (!temporary)
      lock.emplace(folder, [&] {
        log.report(Severity::Info, "atlas-wait", {},
                   "waits for another program that uses the atlas in \"" + folder.string() + "\"");
      });
    const bool byHand = points || isMadeByHand(folder);
    if (byHand) requireFinished(points ? fs::path(given) : folder);
    if (points) bricksOfPoints(given, folder, names, {.maxError = settings.stored.brickMaxError}, log);
    if (!byHand) makeAnewWhatIsDamaged([&] { writeAtlas(folder, {tools, names, atlas, progress, stats, log}); }, log);
    auto maps = std::make_unique<const IrradianceAtlas>(folder, scene, names, brickCacheBytes(settings.resources), log);
    if (byHand) warnOfStrangers(*maps, atlas.world, log);
    return maps;
  } catch (const Stopped&) {
    return nullptr;
  } catch (const std::runtime_error& e) {  // FileError, or an error of the file system
    log.report(severityOfLoss(e), "atlas", {}, std::string(e.what()) + ": rendered without indirect light");
    return nullptr;
  }
}

fs::path photonPart(const fs::path& atlas, WorkPart part) {
  return atlas / "parts" / fmt::format("{:04}of{:04}.ptc", part.index + 1, part.count);
}

void makeAtlasPass(AtlasPass pass, WorkPart part, const RayTools& tools, const RenderSettings& settings,
                   const AtlasProgress& progress, Stats& stats, Log& log) {
  const ShadingSystem& shading = *tools.shading;
  const Scene& scene = tools.rays->scene();
  const fs::path folder = atlasFolder(settings, shading);
  if (isMadeByHand(folder)) return;
  const AtlasSettings atlas = atlasSettings(settings, scene, shading);
  const MapNames names = mapNames(scene, shading, atlas);
  const AtlasWork work{tools, names, atlas, progress, stats, log};
  makeAtlasFolder(folder / "parts");
  const bool hasAll = hasPhotons(folder, names, atlas);
  if (pass == AtlasPass::Photons && !hasAll) {
    const StageTimer timer(stats, "photons");
    writePhotonPart(photonPart(folder, part), part, work);
  } else if (pass == AtlasPass::Join && !hasAll) {
    std::vector<fs::path> parts;
    for (int i = 0; i < part.count; ++i) parts.push_back(photonPart(folder, {i, part.count}));
    joinPhotonParts(parts, folder / "photons", names, atlas, stats, log);
  } else if (pass == AtlasPass::Maps) {
    if (!hasAll)
      throw FileError(fmt::format("\"{}\" has no photons of this scene and these settings", folder.string()));
    writeMaps(folder, part, work);
  }
}

std::unique_ptr<const IrradianceAtlas> openBaked(const Scene& scene, const ShadingSystem& shading,
                                                 const RenderSettings& settings, Log& log) {
  if (settings.stored.bakedFolder.empty()) {
    log.report(Severity::Missing, "baked-folder", {},
               "--gi baked needs --baked FOLDER: rendered without indirect light");
    return nullptr;
  }
  try {
    const AtlasSettings atlas = atlasSettings(settings, scene, shading);
    auto maps = std::make_unique<const IrradianceAtlas>(settings.stored.bakedFolder, scene,
                                                        mapNames(scene, shading, atlas).withoutCausticsAndMedia(),
                                                        brickCacheBytes(settings.resources), log);
    warnOfStrangers(*maps, atlas.world, log);
    return maps;
  } catch (const std::runtime_error& e) {  // FileError, or an error of the file system
    log.report(severityOfLoss(e), "baked", {}, std::string(e.what()) + ": rendered without indirect light");
    return nullptr;
  }
}

void bakeGathered(const GiServices& services, const DeepFrame& layout, const TileReader& tiles, const Scene& scene,
                  const ShadingSystem& shading, const RenderSettings& settings, Log& log) {
  try {
    const AtlasSettings atlas = atlasSettings(settings, scene, shading);
    const MapNames names = mapNames(scene, shading, atlas).withoutCausticsAndMedia();
    makeAnewWhatIsDamaged([&] { services.bake(layout, tiles, settings.stored.bakedFolder, names, atlas.world); }, log);
  } catch (const Stopped&) {  // the records that were gathered before stay
  } catch (const std::runtime_error& e) {
    log.report(Severity::Output, "baked-write", {}, std::string(e.what()) + ": the gathered light is not kept");
  }
}

}  // namespace tomales
