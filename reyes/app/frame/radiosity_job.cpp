#include "reyes/app/frame/radiosity_job.h"

#include <fmt/format.h>

#include <set>

#include "gi/radiosity_bricks.h"
#include "gi/radiosity_picture.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/frame/atlas_job.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/stop.h"
#include "reyes/base/temporary_folder.h"
#include "reyes/image_files.h"
#include "reyes/pictures.h"
#include "reyes/world_sum.h"

namespace tomales {
namespace {

/// Returns a name without characters that file systems refuse, or dots, which begin suffixes. No two names are equal.
std::string fileName(const Object& object, int index, std::set<std::string>& used) {
  std::string name = object.attributes->name.empty() ? fmt::format("object_{}", index) : object.attributes->name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  while (!used.insert(name).second) name += fmt::format("_{}", index);
  return name;
}

void writeMap(const std::vector<RadiosityChart>& charts, const std::filesystem::path& file, Log& log) {
  const TemporaryFolder folder(file.parent_path());
  const std::filesystem::path base = folder.path() / "base.exr";
  std::string error = "cannot be written";
  const bool written =
      writeImage(base.string(), pictureOf(charts), false, log) &&
      makeTexture({.pictures = {base.string()}, .file = file.string(), .sWrap = "clamp", .tWrap = "clamp"}, error) ==
          Making::Done;
  if (!written) throw WriteError(fmt::format("\"{}\": {}", file.string(), error));
}

void writeRadiosityMaps(const RadiosityMaps& maps, const Scene& scene, const std::filesystem::path& folder, Log& log) {
  std::filesystem::create_directories(folder);
  std::set<std::string> used;
  for (int i = 0; i < static_cast<int>(scene.objects.size()); ++i) {
    if (maps.charts(i, false).empty()) continue;
    const std::string name = fileName(scene.objects[static_cast<size_t>(i)], i, used);
    throwIfStopped();
    writeMap(maps.charts(i, false), folder / (name + ".exr"), log);
    if (!maps.charts(i, true).empty()) writeMap(maps.charts(i, true), folder / (name + ".back.exr"), log);
  }
}

std::unique_ptr<const HitRadiance> bricksIn(const std::string& folder, const RayTools& tools, const Camera& camera,
                                            const RadiositySettings& radiosity, const RenderSettings& settings,
                                            Stats& stats, Log& log) {
  try {
    AtlasSettings atlas = atlasSettings(settings, tools.rays->scene(), *tools.shading);
    atlas.world = worldSum(tools.rays->scene(), false);  // `false`, because gather rays meet what photons do not
    if (!settings.stored.radiosityFolder.empty())
      log.report(Severity::Warning, "radiosity-maps", {},
                 "--radiosity-maps: left out, since radiosity goes to brick maps in the folder of --atlas");
    const RadiosityBrickSettings bricks{.points = radiosity, .cacheBytes = brickCacheBytes(settings.resources)};
    const MapNames names = mapNames(tools.rays->scene(), *tools.shading, atlas);
    std::unique_ptr<const RadiosityBricks> out;
    makeAnewWhatIsDamaged(
        [&] { out = std::make_unique<const RadiosityBricks>(folder, tools, camera, names, bricks, stats, log); }, log);
    return out;
  } catch (const Stopped&) {
    return nullptr;
  } catch (const std::runtime_error& e) {  // FileError, or an error of the file system
    log.report(severityOfLoss(e), "radiosity-bricks", {},
               std::string(e.what()) + ": hits of gather rays are shaded instead");
    return nullptr;
  }
}

}  // namespace

std::unique_ptr<const HitRadiance> prepareRadiosity(const RayTools& tools, const Camera& camera,
                                                    const RenderSettings& settings,
                                                    const std::function<void(float)>& progress, Checkpoint* kept,
                                                    Stats& stats, Log& log) {
  const StageTimer timer(stats, "radiosity");
  const Scene& scene = tools.rays->scene();
  RadiositySettings radiosity{settings.stored.radiosityTexels, lightSeedOf(settings)};
  radiosity.progress = progress;
  radiosity.kept = kept;
  if (const std::string folder = atlasFolder(settings, *tools.shading); !folder.empty())
    return bricksIn(folder, tools, camera, radiosity, settings, stats, log);
  std::unique_ptr<const RadiosityMaps> maps;
  try {
    maps = std::make_unique<const RadiosityMaps>(*tools.rays, *tools.shading, camera, radiosity, log);
    if (!settings.stored.radiosityFolder.empty())
      writeRadiosityMaps(*maps, scene, settings.stored.radiosityFolder, log);
  } catch (const Stopped&) {               // the maps that exist may be used
  } catch (const std::runtime_error& e) {  // FileError, or an error of the file system
    log.report(severityOfLoss(e), "radiosity-maps", {},
               fmt::format("radiosity maps cannot be written: {}; they are used all the same", e.what()));
  }
  return maps;
}

}  // namespace tomales
