// Composer: the irradiance atlas (Christensen and Batali 2004, section 4). A folder holds the photons, irradiance
// points and brick maps of a scene, one file of each kind for each map. Gather rays look the brick maps up.
//   FOLDER/photons/NAME.ptc  ->  FOLDER/irradiance/NAME.ptc  ->  FOLDER/NAME.bkm
// Attribute "photon" "globalmap" names the map of an object. Objects without a name are shared out by size among the
// maps "scene0", "scene1", ... A map NAME.caustic holds light that came by mirrors and glass alone. It is looked up
// where the eye sees it, and in its photons where the folder has them, because bricks would spread bright lines into
// the dark beside them. The map scene.volume holds the fluence in media.
// Space: files are in world space, so that another camera can use them. Irradiance: E in W/m2 in files, E/pi from
// IrradianceAtlas. Each file has checksums of what it was made from (MadeFrom), so that only what has changed is made
// again.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "gi/brick_map.h"
#include "gi/photons.h"
#include "gi/photons/caustics.h"
#include "gi/photons/irradiance.h"
#include "gi/world_from_current.h"

namespace tomales {

/// Caustics are sharp, so every photon gets an estimate.
constexpr PhotonIrradianceSettings kCausticIrradiance{50, 1};

struct AtlasSettings {
  PhotonSettings photons;
  PhotonIrradianceSettings irradiance;
  /// maxError is a share of the map's mean irradiance; the paper's is absolute. An estimate averages 50 photons and
  /// stands for four, so voxels as wide as the disks (coarseness 2) hold all of their detail in a quarter of the
  /// bricks.
  BrickSettings bricks{.maxError = 0.03f, .coarseness = 2};
  size_t mostPhotonBytes = 256 << 20;  ///< The most bytes that the photons of one unnamed map are expected to take.
  uint64_t world = 0;                  ///< worldSum() of the scene.
};

/// The names of the maps of each of Scene::groups, and the number of the group's surface in its map. By these numbers,
/// surfaces that touch do not share light.
struct MapNames {
  std::vector<std::string> global;
  std::vector<std::string> caustic;  ///< Ends in kCaustic; empty: the group has none.
  std::string volume;                ///< The map of photons in media; empty: there are none.
  /// PointCloud::surface() of the group's points; 0: it is too small to have light of its own.
  std::vector<int> surface;
  uint64_t world = 0;  ///< AtlasSettings::world of the groups.
  std::set<std::string> all() const;
  /// Returns the maps that gather rays look up: all but that of media, which shaders read.
  std::set<std::string> ofReflectors() const;
  MapNames ofSurfaces() const;  ///< The same without caustics and media: baked light has no maps of these.
};
MapNames mapNames(const Scene& scene, const ShadingSystem& shading, const AtlasSettings& settings);

/// Returns the file of a map in a folder.
std::filesystem::path atlasFile(const std::filesystem::path& folder, const std::string& map, const char* extension);
void makeAtlasFolder(const std::filesystem::path& folder);  ///< Throws WriteError.

using AtlasProgress = std::function<void(float)>;

/// Traces photons into FOLDER, one file for each map. Throws FileError.
PhotonFigures writePhotons(const std::filesystem::path& folder, const Scene& scene, const RayScene& rays,
                           const ShadingSystem& shading, const MapNames& names, const AtlasSettings& settings,
                           const AtlasProgress& progress, Stats& stats, Log& log);
/// Traces a part of the same photons into one file for all maps. Throws FileError.
PhotonFigures writePhotonPart(const std::filesystem::path& file, WorkPart part, const Scene& scene,
                              const RayScene& rays, const ShadingSystem& shading, const MapNames& names,
                              const AtlasSettings& settings, const AtlasProgress& progress, Stats& stats, Log& log);
/// Makes the files of writePhotons() of all its parts. Throws FileError, also where a part is of another scene.
void joinPhotonParts(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                     const MapNames& names, const AtlasSettings& settings, Stats& stats, Log& log);
/// Makes irradiance points from a photon map. A map of more than `most` photons is processed in cubes of about so many.
/// `sight` and `shown`: as in estimateIrradiance(), in world space. Throws FileError.
void writeIrradiance(const std::filesystem::path& photons, const std::filesystem::path& out,
                     const PhotonIrradianceSettings& settings, uint64_t most = kPointsInMemory,
                     EstimateFigures* figures = nullptr, const SightAlongSurface& sight = {},
                     const ShownDisk& shown = {});
/// Makes a brick map from irradiance points; its maxError is relative to their mean. Throws FileError.
BuiltBricks writeIrradianceBricks(const std::filesystem::path& points, const std::filesystem::path& out,
                                  BrickSettings settings);

/// Makes the brick map again if its points or settings have changed. Returns false if the old one is kept. Throws
/// FileError.
bool renewIrradianceBricks(const std::filesystem::path& points, const std::filesystem::path& out,
                           const BrickSettings& settings, Stats& stats);
/// Reads the MadeFrom of a point cloud; zeros for a file that is missing. Throws FileError.
MadeFrom pointsMadeFrom(const std::filesystem::path& path);

/// Tells whether FOLDER/photons holds the photons of this scene and these settings.
bool hasPhotons(const std::filesystem::path& folder, const MapNames& names, const AtlasSettings& settings);
/// Makes irradiance and brick maps from the photons in FOLDER/photons, for the maps of one part, unless they are there
/// already. Throws FileError.
void writeMaps(const std::filesystem::path& folder, WorkPart part, const Scene& scene, const RayScene& rays,
               const MapNames& names, const AtlasSettings& settings, const AtlasProgress& progress, Stats& stats,
               Log& log);
/// Makes all three kinds of files for a scene, as far as the folder does not hold them yet. Photons are traced again if
/// the scene or their settings have changed, and groups that receive the same photons keep their maps. Throws
/// FileError.
void writeAtlas(const std::filesystem::path& folder, const Scene& scene, const RayScene& rays,
                const ShadingSystem& shading, const MapNames& names, const AtlasSettings& settings,
                const AtlasProgress& progress, Stats& stats, Log& log);

/// Tells whether there are brick maps without the photons that they came from. Somebody put them there, and they are
/// used unchanged.
bool isMadeByHand(const std::filesystem::path& folder);
/// Tells whether the brick maps of a folder hold light that came straight from lights (PhotonSettings::direct).
bool holdsDirect(const std::filesystem::path& folder);

/// The brick maps of a folder. Threads: lookups are concurrent.
class IrradianceAtlas {
 public:
  /// Maps that are missing are black, with a warning: nothing was lit there. Throws FileError where one is damaged.
  IrradianceAtlas(const std::filesystem::path& folder, const Scene& scene, const MapNames& names, size_t cacheBytes,
                  Log& log);

  /// Names a map that was made from another world than this, if there is one. A world of 0, and maps that do not name
  /// theirs, match any.
  std::optional<std::string> strange(uint64_t world) const;

  /// Returns E/pi at P (current space) on the side of N, averaged over a radius; 0 where there is no data.
  /// `acrossWalls`: as in BrickMap::lookup().
  vec3 irradianceOverPi(int group, const vec3& P, const vec3& N, float radius, bool& acrossWalls) const {
    acrossWalls = false;
    return look(mapOfGroup_, group, P, N, radius, &acrossWalls).value_or(vec3(0.0f));
  }
  /// Returns the same for light that came by mirrors and glass alone.
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
  /// Returns the number of a group's surface in a map; 0: not known, as maps of another scene have other numbers.
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
