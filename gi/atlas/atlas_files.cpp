#include "gi/atlas_files.h"

#include <fmt/format.h>

#include "gi/atlas/leaks.h"
#include "gi/atlas/limits.h"
#include "gi/atlas/photon_maps.h"
#include "gi/atlas/sight_lines.h"
#include "gi/bricks/point_tiles.h"
#include "reyes/base/process.h"
#include "reyes/base/temporary_folder.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

uint64_t irradianceInputs(const PointFile& photons, const PhotonIrradianceSettings& settings, bool knowsWalls) {
  const auto& [nearest, every, maxRadius] = settings;
  return contentSum(kAtlasMethod, photons.contents(), nearest, every, maxRadius, knowsWalls);
}

uint64_t brickInputs(const PointFile& points, const BrickSettings& settings) {
  const auto& [maxError, maxDepth, radiusScale, ignoreNormals, coarseness] = settings;
  return contentSum(kAtlasMethod, points.contents(), maxError, maxDepth, radiusScale, ignoreNormals, coarseness);
}

}  // namespace

MadeFrom pointsMadeFrom(const fs::path& path) {
  std::error_code none;
  return fs::exists(path, none) ? PointFile(path.string()).madeFrom() : MadeFrom{};
}

fs::path atlasFile(const fs::path& folder, const std::string& map, const char* extension) {
  std::string name = map;
  for (char& c : name)
    if (c == '/' || c == '\0') c = '_';
  return folder / (name + extension);
}

void makeAtlasFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder, error))
    throw WriteError(fmt::format("folder \"{}\" cannot be made: {}", folder.string(), error.message()));
}

void writeIrradiance(const fs::path& photons, const fs::path& out, const PhotonIrradianceSettings& given, uint64_t most,
                     EstimateFigures* figures, const SightAlongSurface& sight, const ShownDisk& shown) {
  const PointFile file(photons.string());
  if (offsetOf(file.channels(), kPathPower, 3) < 0) requirePhotons(file);
  const MadeFrom madeFrom{file.madeFrom().world, irradianceInputs(file, given, static_cast<bool>(sight))};
  if (file.count() <= most)
    return writePointFile(estimateIrradiance(file.readAll(), given, {}, figures, sight, shown), out.string(), madeFrom);
  PhotonIrradianceSettings settings = given;
  settings.maxRadius = reachOf(given, file.bound());
  const TemporaryFolder temporary(out.parent_path().empty() ? "." : out.parent_path());
  // Chunks of photons spread over the whole scene, so they are sorted first.
  const fs::path compact = temporary.path() / "photons.ptc";
  PointTiles(file).writeCompact(compact.string());
  const PointFile sorted(compact.string());
  const PointTiles tiles(sorted);
  PointFileWriter writer(out.string(), irradianceChannels(sorted.channels()));
  forEachTile(tiles, most, [&](int level, const glm::ivec3& place) {
    const auto inside = [&](const vec3& P) { return tiles.contains(level, place, P); };
    const PointCloud points = estimateIrradiance(tiles.around(tiles.box(level, place), settings.maxRadius), settings,
                                                 inside, figures, sight, shown);
    for (size_t i = 0; i < points.count(); ++i)
      writer.add(points.position[i], points.normal[i], points.radius[i], points.at(i));
  });
  writer.finish(madeFrom);
}

BuiltBricks writeIrradianceBricks(const fs::path& points, const fs::path& out, BrickSettings settings) {
  const PointFile file(points.string());
  const MadeFrom madeFrom{file.madeFrom().world, brickInputs(file, settings)};
  const PointTiles tiles(file);
  settings.maxError *= static_cast<float>(tiles.meanOfData());
  return writeBrickMap(tiles, settings, out.string(), madeFrom);
}

bool renewIrradianceBricks(const fs::path& points, const fs::path& out, const BrickSettings& settings, Stats& stats) {
  std::error_code none;
  if (fs::exists(out, none)) {
    const BrickFile kept(out.string());
    if (kept.madeFrom().inputs == brickInputs(PointFile(points.string()), settings)) {
      kept.readAll();
      return false;
    }
  }
  const StageTimer timer(stats, "brickmake");
  writeIrradianceBricks(points, out, settings);
  return true;
}

namespace {

/// What estimates ask of the scene around them. The functions are empty if they ask nothing.
struct SceneAround {
  SightAlongSurface sight;
  ShownDisk shown;
};

/// If photons hold direct light too, hits have no other source of it. So they take whatever is stored near them, walls
/// or not, and places of few photons may be shadows.
SceneAround sceneAround(const AtlasWork& work) {
  if (work.settings.photons.direct) return {};
  return {sightAlongSurfaces(*work.tools.rays), shownBy(*work.tools.rays)};
}

struct WrittenMap {
  EstimateFigures figures;   ///< Empty if the estimates are kept.
  bool keepsBricks = false;  ///< The bricks were there already.
};

/// Makes the irradiance points and the bricks of a map, unless they are there already.
WrittenMap writeMap(const fs::path& folder, const std::string& name, const SceneAround& around, const AtlasWork& work) {
  const fs::path photons = atlasFile(folder / "photons", name, ".ptc"),
                 points = atlasFile(folder / "irradiance", name, ".ptc");
  const bool caustic = MapNames::isCaustic(name);
  const PhotonIrradianceSettings& estimate = caustic ? kCausticIrradiance : work.settings.irradiance;
  const SightAlongSurface sight = caustic || name == work.names.volume ? nullptr : around.sight;
  WrittenMap out;
  if (pointsMadeFrom(points).inputs !=
      irradianceInputs(PointFile(photons.string()), estimate, static_cast<bool>(sight))) {
    const StageTimer timer(work.stats, "irradiance");
    writeIrradiance(photons, points, estimate, kPointsInMemory, &out.figures, sight,
                    caustic ? ShownDisk() : around.shown);
  }
  out.keepsBricks = !renewIrradianceBricks(points, atlasFile(folder, name, ".bkm"), work.settings.bricks, work.stats);
  returnFreeMemory();
  return out;
}

}  // namespace

void writeMaps(const fs::path& folder, WorkPart part, const AtlasWork& work) {
  makeAtlasFolder(folder / "irradiance");
  const SceneAround around = sceneAround(work);
  const std::set<std::string> maps = work.names.all();
  std::vector<MapFigures> made;
  int finished = 0, kept = 0;  // A damaged map ends this, and all are counted anew.
  for (const std::string& name : maps) {
    const bool isOfThisPart = finished++ % part.count == part.index;
    const WrittenMap map = isOfThisPart ? writeMap(folder, name, around, work) : WrittenMap{};
    kept += map.keepsBricks;
    if (name != work.names.volume) {
      const PointFile photons(atlasFile(folder / "photons", name, ".ptc").string());
      made.push_back({name, photons.count(), map.figures});
    }
    if (work.progress) work.progress(static_cast<float>(finished) / static_cast<float>(maps.size()));
  }
  work.stats.photons.groupsKept += kept;
  warnOfEstimates(work.scene(), work.names, made, work.log);
}

void writeAtlas(const fs::path& folder, const AtlasWork& work) {
  constexpr float kShareOfPhotons = 0.6f;  // about this share of the time
  const auto within = [&](float from, float to) {
    AtlasWork stage = work;
    if (work.progress) stage.progress = [&work, from, to](float share) { work.progress(from + (to - from) * share); };
    return stage;
  };
  makeAtlasFolder(folder);
  if (!hasPhotons(folder, work.names, work.settings)) {
    const StageTimer timer(work.stats, "photons");
    writePhotons(folder / "photons", within(0, kShareOfPhotons));
  }
  returnFreeMemory();
  writeMaps(folder, {}, within(kShareOfPhotons, 1));
  if (work.settings.photons.direct) warnOfLeaks(folder, work.scene(), *work.tools.rays, work.names, work.log);
}

}  // namespace tomales
