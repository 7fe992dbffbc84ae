#include <fmt/format.h>

#include <map>
#include <set>

#include "gi/atlas.h"
#include "gi/point_file.h"

namespace tomales {

namespace fs = std::filesystem;

bool holdsDirect(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) try {
      if (entry.path().extension() == ".bkm" &&
          offsetOf(BrickFile(entry.path().string()).channels(), kIndirectIrradiance) >= 0)
        return false;
    } catch (const FileError&) {  // the problem is reported when the file is used
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
    : cache_(cacheBytes), toWorld_(scene), log_(log) {
  std::map<std::string, const BrickMap*> byName{{"", nullptr}};
  openCaustics(folder / "photons", names);
  for (const std::string& name : names.surfaceMaps())
    byName[name] = caustics_.contains(name) ? nullptr : open(atlasFile(folder, name, ".bkm"));
  for (const std::string& name : names.global) mapOfGroup_.push_back(byName.at(name));
  for (const std::string& name : names.caustic) causticOfGroup_.push_back(byName.at(name));
  surfaceOfGroup_ = names.surface;
  world_ = names.world;
}

void IrradianceAtlas::openCaustics(const fs::path& folder, const MapNames& names) {
  for (const std::string& name : std::set<std::string>(names.caustic.begin(), names.caustic.end())) {
    const fs::path path = atlasFile(folder, name, ".ptc");
    if (!name.empty() && fs::exists(path)) try {
        const PointFile file(path.string());
        requirePhotons(file);
        caustics_.try_emplace(name, Photons{file.madeFrom(), CausticPhotons(file.readAll(), kCausticIrradiance)});
      } catch (const FileError& e) {
        log_.report(Severity::Missing, "atlas-damaged", {},
                    fmt::format("{}: caustics come from its brick map", e.what()));
      }
  }
  for (const std::string& name : names.caustic) {
    const auto found = caustics_.find(name);
    causticPhotonsOfGroup_.push_back(found == caustics_.end() ? nullptr : &found->second);
  }
}

vec3 IrradianceAtlas::causticOverPi(int group, const vec3& P, const vec3& N, float radius) const {
  const Photons* map = causticPhotonsOfGroup_[static_cast<size_t>(group)];
  if (!map) return look(causticOfGroup_, group, P, N, radius).value_or(vec3(0.0f));
  return map->photons.irradiance(transformPoint(toWorld_.points, P), worldNormal(N), surfaceIn(map->from, group),
                                 radius * toWorld_.scale) /
         kPi;
}

const BrickMap* IrradianceAtlas::open(const fs::path& file) {
  if (!fs::exists(file)) {
    log_.report(Severity::Missing, "atlas-no-map", {},
                fmt::format("irradiance map \"{}\" is missing: its objects reflect no indirect light", file.string()));
    return nullptr;
  }
  maps_.push_back(std::make_unique<const BrickMap>(file.string(), cache_));
  if (maps_.back()->width() != 3)
    throw FileError(fmt::format("\"{}\" is no irradiance map: it does not have three channels", file.string()));
  return maps_.back().get();
}

std::optional<std::string> IrradianceAtlas::mapOfOtherWorld(uint64_t world) const {
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
    if (map->lookup(transformPoint(toWorld_.points, P), worldNormal(N), radius * toWorld_.scale, &E.x,
                    surfaceIn(map->file().madeFrom(), group), acrossWalls))
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
