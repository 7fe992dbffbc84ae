// Shares the objects of a scene out among photon maps.
#include <fmt/format.h>

#include <map>
#include <numeric>

#include "gi/atlas_files.h"
#include "gi/photons/medium.h"

namespace tomales {
namespace {

constexpr std::string_view kCaustic = ".caustic";  ///< Ending of the names of caustic maps.
constexpr const char* kVolume = "scene.volume";
/// Bytes for each emitted photon: the mean number of times that it is stored, times the bytes of a stored photon.
constexpr double kStoredBytes = 2.5 * 36;
/// Share of its map's area that a surface needs to have a number. Smaller ones, such as leaves, share their photons.
constexpr double kLeastOfMap = 1e-3;

/// Returns the area of the boxes of each group's objects in world space, so that every camera finds the same maps.
std::vector<double> boxAreas(const Scene& scene) {
  std::vector<double> areas(scene.groups.size(), 0.0);
  for (const Object& o : scene.objects) {
    if (o.shapes.empty()) continue;  // the scene has dropped it
    Bound3 bound;
    for (uint32_t patch = 0; patch < o.shape().patchCount(); ++patch) bound.extend(o.shape().bound(patch, {}));
    const vec3 s = bound.empty() ? vec3(0) : transformBound(o.worldFromObject.keys.front(), bound).size();
    areas[static_cast<size_t>(o.group)] += double{s.x * s.y + s.y * s.z + s.z * s.x};
  }
  return areas;
}

/// Numbers the surfaces of each map from 1; small ones get 0.
std::vector<int> numbered(const std::vector<std::string>& maps, const std::vector<double>& areas) {
  struct Map {
    double area = 0;
    int groups = 0;
  };
  std::map<std::string, Map> byName;
  for (size_t g = 0; g < maps.size(); ++g) byName[maps[g]].area += areas[g];
  std::vector<int> out;
  for (size_t g = 0; g < maps.size(); ++g) {
    Map& map = byName[maps[g]];
    // Small surfaces are counted too, so that the numbers do not depend on which surfaces are small.
    const int number = 1 + map.groups++ % kMostSurfaces;
    out.push_back(areas[g] >= kLeastOfMap * map.area ? number : 0);
  }
  return out;
}

}  // namespace

bool MapNames::isCaustic(const std::string& map) { return map.ends_with(kCaustic); }

MapNames mapNames(const Scene& scene, const ShadingSystem& shading, const AtlasSettings& settings) {
  const std::vector<double> own = boxAreas(scene);
  std::vector<double> areas = own;
  for (size_t g = 0; g < areas.size(); ++g)
    if (!scene.groups[g].attributes->photon.globalMap.empty()) areas[g] = 0;
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double share = total * std::min(1.0, static_cast<double>(settings.mostPhotonBytes) /
                                                 (kStoredBytes * static_cast<double>(settings.photons.emit)));
  MapNames names;
  names.world = settings.world;
  double before = 0;  // Groups follow the order of objects in the scene, so neighbours in its hierarchy stay together.
  for (size_t g = 0; g < areas.size(); ++g) {
    const std::string& given = scene.groups[g].attributes->photon.globalMap;
    const std::string& caustic = scene.groups[g].attributes->photon.causticMap;
    names.global.push_back(!given.empty() ? given
                                          : fmt::format("scene{}", share > 0 ? static_cast<int>(before / share) : 0));
    names.caustic.push_back(!caustic.empty() ? caustic + std::string(kCaustic) : "");
    before += areas[g];
  }
  names.surface = numbered(names.global, own);
  for (int g = 0; g < static_cast<int>(scene.groups.size()); ++g)
    for (const bool inside : {true, false})
      if (!mediumOf(shading.group(g).medium(inside), 1).empty()) names.volume = kVolume;
  return names;
}

std::set<std::string> MapNames::surfaceMaps() const {
  std::set<std::string> out(global.begin(), global.end());
  out.insert(caustic.begin(), caustic.end());
  out.erase("");
  return out;
}

std::set<std::string> MapNames::all() const {
  std::set<std::string> out = surfaceMaps();
  if (!volume.empty()) out.insert(volume);
  return out;
}

MapNames MapNames::withoutCausticsAndMedia() const {
  MapNames out = *this;
  out.caustic.assign(caustic.size(), "");
  out.volume.clear();
  return out;
}

}  // namespace tomales
