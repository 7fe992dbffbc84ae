// Noun: the irradiance atlas, as gather rays and shaders look it up (Christensen and Batali 2004, section 4).
// gi/atlas_files.h makes its files. Space: current. Irradiance: E/pi.
#pragma once
#include <filesystem>
#include <map>
#include <optional>

#include "gi/atlas_files.h"
#include "gi/brick_map.h"
#include "gi/photons/caustics.h"
#include "gi/world_from_current.h"

namespace tomales {

/// Tells whether the folder has brick maps without the photons that such maps come from. Somebody put them there, and
/// they are used unchanged.
bool isMadeByHand(const std::filesystem::path& folder);
/// Tells whether the brick maps of a folder hold light that came straight from lights (PhotonSettings::direct).
bool holdsDirect(const std::filesystem::path& folder);

/// The brick maps of a folder. Threads: lookups are concurrent.
class IrradianceAtlas {
 public:
  /// Maps that are missing are black, with a warning: nothing was lit there. Throws FileError where one is damaged.
  IrradianceAtlas(const std::filesystem::path& folder, const Scene& scene, const MapNames& names, size_t cacheBytes,
                  Log& log);

  /// Returns the name of a map that was made from a world other than `world`, if there is one. A world of 0 matches all
  /// maps, and a map that does not name its world matches all worlds.
  std::optional<std::string> mapOfOtherWorld(uint64_t world) const;

  /// Returns E/pi at P (current space) on the side of N, averaged over a radius; 0 where there is no data.
  /// `acrossWalls`: as in BrickMap::lookup().
  vec3 irradianceOverPi(int group, const vec3& P, const vec3& N, float radius, bool& acrossWalls) const {
    acrossWalls = false;
    return look(mapOfGroup_, group, P, N, radius, &acrossWalls).value_or(vec3(0.0f));
  }
  /// Returns the same for caustics alone, which are light that came by mirrors and glass.
  vec3 causticOverPi(int group, const vec3& P, const vec3& N, float radius) const;
  /// Returns the same as irradianceOverPi(), but empty where there is no data.
  std::optional<vec3> bakedOverPi(int group, const vec3& P, const vec3& N, float radius) const {
    return look(mapOfGroup_, group, P, N, radius);
  }
  void report(Stats& stats) const;  ///< Adds bricks, lookups, misses and bytes.

 private:
  using MapOfGroup = std::vector<const BrickMap*>;  ///< Null: no photon came there.
  std::optional<vec3> look(const MapOfGroup& maps, int group, const vec3& P, const vec3& N, float radius,
                           bool* acrossWalls = nullptr) const;
  const BrickMap* open(const std::filesystem::path& file);
  void openCaustics(const std::filesystem::path& folder, const MapNames& names);
  vec3 worldNormal(const vec3& N) const { return normalizeOr(toWorld_.normals * N, N); }
  /// Returns the number of a group's surface in a map; 0 if it is not known, because maps of another scene have other
  /// numbers.
  int surfaceIn(const MadeFrom& from, int group) const {
    return world_ != 0 && from.world == world_ ? surfaceOfGroup_[static_cast<size_t>(group)] : 0;
  }

  mutable BrickCache cache_;
  WorldFromCurrent toWorld_;
  std::vector<std::unique_ptr<const BrickMap>> maps_;  ///< Sorted by name.
  struct Photons {
    MadeFrom from;
    CausticPhotons photons;
  };
  std::map<std::string, Photons> caustics_;
  MapOfGroup mapOfGroup_, causticOfGroup_;             ///< Caustics from bricks, where there are no photons.
  std::vector<const Photons*> causticPhotonsOfGroup_;  ///< Null: there are none.
  std::vector<int> surfaceOfGroup_;
  uint64_t world_ = 0;
  Log& log_;
};

}  // namespace tomales
