#include <fmt/format.h>

#include <map>

#include "gi/atlas.h"

namespace tomales {

namespace fs = std::filesystem;

bool holdsDirect(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) try {
      if (entry.path().extension() == ".bkm" &&
          offsetOf(BrickFile(entry.path().string()).channels(), kIndirectIrradiance) >= 0)
        return false;
    } catch (const FileError&) {  // reported when it is used
    }
  return true;
}

bool isMadeByHand(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "photons", error)) return false;
  const fs::directory_iterator files(folder, error);
  return !error &&
         std::any_of(begin(files), end(files), [](const auto& entry) { return entry.path().extension() == ".bkm"; });
}

IrradianceAtlas::IrradianceAtlas(const fs::path& folder, const Scene& scene, const MapNames& names, size_t cacheBytes,
                                 Log& log)
    : cache_(cacheBytes),
      worldFromCurrent_(glm::inverse(scene.cameraFromWorldAtOpen())),
      worldFromCurrentScale_(std::cbrt(std::abs(glm::determinant(mat3(worldFromCurrent_))))),
      log_(log) {
  std::map<std::string, const BrickMap*> byName{{"", nullptr}};
  for (const std::string& name : names.ofReflectors()) byName[name] = open(atlasFile(folder, name, ".bkm"));
  for (const std::string& name : names.global) mapOfGroup_.push_back(byName.at(name));
  for (const std::string& name : names.caustic) causticOfGroup_.push_back(byName.at(name));
  surfaceOfGroup_ = names.surface;
  world_ = names.world;
}

const BrickMap* IrradianceAtlas::open(const fs::path& file) {
  if (!fs::exists(file)) {
    log_.report(Severity::Missing, "atlas-no-map", {},
                fmt::format("irradiance map \"{}\" is missing: its objects reflect no indirect light", file.string()));
    return nullptr;
  }
  maps_.push_back(std::make_unique<const BrickMap>(file.string(), cache_));
  if (maps_.back()->width() != 3)
    throw FileError(fmt::format("\"{}\" is no irradiance map: it has not three channels", file.string()));
  return maps_.back().get();
}

std::optional<std::string> IrradianceAtlas::strange(uint64_t world) const {
  for (const auto& map : maps_)
    if (const uint64_t from = map->file().madeFrom().world; from != 0 && world != 0 && from != world)
      return map->file().path();
  return std::nullopt;
}

std::optional<vec3> IrradianceAtlas::look(const MapOfGroup& maps, int group, const vec3& P, const vec3& N, float radius,
                                          bool* acrossWalls) const {
  const BrickMap* map = maps[static_cast<size_t>(group)];
  if (!map) return std::nullopt;
  try {
    vec3 E(0.0f);
    const vec3 normal = normalizeOr(transformVector(worldFromCurrent_, N), N);
    // Maps of another scene have other numbers for their surfaces.
    const int surface =
        world_ != 0 && map->file().madeFrom().world == world_ ? surfaceOfGroup_[static_cast<size_t>(group)] : 0;
    if (map->lookup(transformPoint(worldFromCurrent_, P), normal, radius * worldFromCurrentScale_, &E.x, surface,
                    acrossWalls))
      return E / kPi;
  } catch (const FileError& e) {
    log_.report(Severity::Missing, "atlas-damaged", {}, fmt::format("{}: no indirect light from there", e.what()));
  }
  return std::nullopt;
}

void IrradianceAtlas::report(Stats& stats) const {
  int64_t total = 0, onDisk = 0;
  for (const auto& map : maps_) {
    total += static_cast<int64_t>(map->file().tree().nodes.size());
    onDisk += static_cast<int64_t>(map->file().fileBytes());
  }
  stats.bricks.total += total;
  stats.bricks.bytesOnDisk += onDisk;
  stats.bricks.lookups += cache_.lookups();
  stats.bricks.misses += cache_.misses();
  stats.bricks.cacheBytes += static_cast<int64_t>(cache_.bytes());
}

}  // namespace tomales
