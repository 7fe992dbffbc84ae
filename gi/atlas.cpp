#include "gi/atlas.h"

#include <fmt/format.h>

#include <map>
#include <numeric>

#include "gi/point_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr double kStoredBytes = 2.5 * 32;  ///< Of one emitted photon: so many surfaces, so many bytes.

fs::path fileOf(const fs::path& folder, const std::string& map, const char* extension) {
  std::string name = map;
  for (char& c : name)
    if (c == '/' || c == '\0') c = '_';
  return folder / (name + extension);
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) throw FileError(fmt::format("folder \"{}\" cannot be made: {}", folder.string(), error.message()));
}

/// Size of the objects of each group, as the area of their boxes.
std::vector<double> boxAreas(const Scene& scene) {
  std::vector<double> areas(scene.groups.size(), 0.0);
  for (const Object& o : scene.objects) {
    Bound3 bound;
    for (uint32_t patch = 0; patch < o.shape().patchCount(); ++patch) bound.extend(o.shape().bound(patch, {}));
    const vec3 s = bound.empty() ? vec3(0) : transformBound(o.cameraFromObject.keys.front(), bound).size();
    areas[static_cast<size_t>(o.group)] += double{s.x * s.y + s.y * s.z + s.z * s.x};
  }
  return areas;
}

}  // namespace

float meanOf(const PointCloud& cloud) {
  double sum = 0;
  for (const float v : cloud.data) sum += double{v};
  return cloud.data.empty() ? 0.0f : static_cast<float>(sum / static_cast<double>(cloud.data.size()));
}

std::vector<std::string> mapNames(const Scene& scene, const AtlasSettings& settings) {
  std::vector<double> areas = boxAreas(scene);
  for (size_t g = 0; g < areas.size(); ++g)
    if (!scene.groups[g].attributes->photon.globalMap.empty()) areas[g] = 0;
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double share = total * std::min(1.0, static_cast<double>(settings.mostPhotonBytes) /
                                                 (kStoredBytes * static_cast<double>(settings.photons.emit)));
  std::vector<std::string> names;
  double before = 0;  // groups follow each other as objects do in the scene: neighbours in its hierarchy stay together
  for (size_t g = 0; g < areas.size(); ++g) {
    const std::string& given = scene.groups[g].attributes->photon.globalMap;
    names.push_back(!given.empty() ? given : fmt::format("scene{}", share > 0 ? static_cast<int>(before / share) : 0));
    before += areas[g];
  }
  return names;
}

PhotonFigures writePhotons(const fs::path& folder, const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                           const AtlasSettings& settings, const AtlasProgress& progress, Stats& stats, Log& log) {
  makeFolder(folder);
  const std::vector<std::string> names = mapNames(scene, settings);
  std::map<std::string, PointFileWriter> files;
  std::vector<PointFileWriter*> fileOfGroup;
  for (const std::string& name : names)
    fileOfGroup.push_back(&files.try_emplace(name, fileOf(folder, name, ".ptc").string(), std::vector<CloudChannel>{{"power", 3}}).first->second);
  const mat4 worldFromCurrent = glm::inverse(scene.cameraFromWorldAtOpen());
  const mat3 normalMatrix = glm::transpose(mat3(scene.cameraFromWorldAtOpen()));
  const PhotonFigures figures = tracePhotons(
      scene, rays, shading, settings.photons,
      [&](const StoredPhoton& p) {
        fileOfGroup[static_cast<size_t>(p.group)]->add(transformPoint(worldFromCurrent, p.P), normalizeOr(normalMatrix * p.N, vec3(0, 0, 1)),
                                                       0, &p.power.x);
      },
      progress, stats, log);
  for (auto& [name, file] : files) {
    file.finish();
    if (file.count() == 0)
      log.report(Severity::Warning, "photons-none-" + name, {}, fmt::format("no photon came to the objects of photon map \"{}\"", name));
  }
  stats.photons.emitted += figures.emitted, stats.photons.stored += figures.stored;
  stats.photons.groups += static_cast<int64_t>(files.size());
  return figures;
}

void writeIrradiance(const fs::path& photons, const fs::path& out, const PhotonIrradianceSettings& settings) {
  const PointFile file(photons.string());
  PointCloud cloud = file.readAll();
  if (cloud.offsetOf("power") < 0) throw FileError(fmt::format("\"{}\" is no photon map: it has no channel \"power\"", photons.string()));
  writePointFile(estimateIrradiance(cloud, settings), out.string());
}

BuiltBricks writeIrradianceBricks(const fs::path& points, const fs::path& out, BrickSettings settings) {
  const PointCloud cloud = PointFile(points.string()).readAll();
  settings.maxError *= meanOf(cloud);
  return writeBrickMap(cloud, settings, out.string());
}

void writeAtlas(const fs::path& folder, const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                const AtlasSettings& settings, const AtlasProgress& progress, Stats& stats, Log& log) {
  const fs::path photons = folder / "photons", irradiance = folder / "irradiance";
  makeFolder(irradiance);
  {
    const StageTimer timer(stats, "photons");
    writePhotons(photons, scene, rays, shading, settings, progress, stats, log);
  }
  std::vector<std::string> names = mapNames(scene, settings);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (const std::string& name : names) {
    {
      const StageTimer timer(stats, "irradiance");
      writeIrradiance(fileOf(photons, name, ".ptc"), fileOf(irradiance, name, ".ptc"), settings.irradiance);
    }
    const StageTimer timer(stats, "brickmake");
    writeIrradianceBricks(fileOf(irradiance, name, ".ptc"), fileOf(folder, name, ".bkm"), settings.bricks);
  }
}

IrradianceAtlas::IrradianceAtlas(const fs::path& folder, const Scene& scene, const AtlasSettings& settings, size_t cacheBytes, Log& log)
    : cache_(cacheBytes),
      worldFromCurrent_(glm::inverse(scene.cameraFromWorldAtOpen())),
      worldFromCurrentScale_(std::cbrt(std::abs(glm::determinant(mat3(worldFromCurrent_))))),
      log_(log) {
  std::map<std::string, const BrickMap*> byName;
  for (const std::string& name : mapNames(scene, settings)) {
    auto [at, isNew] = byName.try_emplace(name, nullptr);
    const fs::path file = fileOf(folder, name, ".bkm");
    if (isNew && fs::exists(file)) {
      maps_.push_back(std::make_unique<const BrickMap>(file.string(), cache_));
      if (maps_.back()->width() != 3) throw FileError(fmt::format("\"{}\" is no irradiance map: it has not three channels", file.string()));
      at->second = maps_.back().get();
    } else if (isNew) {
      log.report(Severity::Missing, "atlas-no-map-" + name, {},
                 fmt::format("irradiance map \"{}\" is missing: its objects reflect no indirect light", file.string()));
    }
    mapOfGroup_.push_back(at->second);
  }
}

vec3 IrradianceAtlas::irradianceOverPi(int group, const vec3& P, const vec3& N, float radius) const {
  const BrickMap* map = mapOfGroup_[static_cast<size_t>(group)];
  vec3 E(0.0f);
  if (!map) return E;
  try {
    const vec3 normal = normalizeOr(transformVector(worldFromCurrent_, N), N);
    map->lookup(transformPoint(worldFromCurrent_, P), normal, radius * worldFromCurrentScale_, &E.x);
  } catch (const FileError& e) {
    log_.report(Severity::Missing, "atlas-damaged", {}, fmt::format("{}: no indirect light from there", e.what()));
  }
  return E / kPi;
}

void IrradianceAtlas::report(Stats& stats) const {
  int64_t total = 0, onDisk = 0;
  for (const auto& map : maps_) total += static_cast<int64_t>(map->file().tree().nodes.size()), onDisk += static_cast<int64_t>(map->file().fileBytes());
  stats.bricks.total += total, stats.bricks.bytesOnDisk += onDisk;
  stats.bricks.lookups += cache_.lookups(), stats.bricks.misses += cache_.misses();
  stats.bricks.cacheBytes += static_cast<int64_t>(cache_.bytes());
}

}  // namespace tomales
