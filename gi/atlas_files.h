// Composer: the files of the irradiance atlas (Christensen and Batali 2004, section 4). A folder holds the photons,
// irradiance points and brick maps of a scene, one file of each kind for each map. gi/atlas.h looks them up.
//   FOLDER/photons/NAME.ptc  ->  FOLDER/irradiance/NAME.ptc  ->  FOLDER/NAME.bkm
// Attribute "photon" "globalmap" names the map of an object. Objects without a name are shared out by size among the
// maps "scene0", "scene1", ... A map NAME.caustic holds light that came by mirrors and glass alone. It is looked up
// where the eye sees it, and in its photons where the folder has them, because bricks would spread bright lines into
// the dark beside them. The map scene.volume holds the fluence in media.
// Space: world, so that another camera can use the files. Irradiance: E in W/m2. Each file has checksums of what it was
// made from (MadeFrom), so that only what has changed is made again.
#pragma once
#include <filesystem>
#include <set>

#include "gi/brick_map.h"
#include "gi/photons.h"
#include "gi/photons/irradiance.h"

namespace tomales {

/// Caustics are sharp, so every photon gets an estimate.
constexpr PhotonIrradianceSettings kCausticIrradiance{.every = 1};

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
  std::vector<std::string> caustic;  ///< Empty: the group has none.
  std::string volume;                ///< The map of photons in media; empty: there are none.
  /// PointCloud::surface() of the group's points; 0: it is too small to have light of its own.
  std::vector<int> surface;
  uint64_t world = 0;  ///< AtlasSettings::world of the groups.
  std::set<std::string> all() const;
  static bool isCaustic(const std::string& map);  ///< Tells whether a map of this name holds caustics.
  /// Returns the maps that gather rays look up: all but that of media, which shaders read.
  std::set<std::string> surfaceMaps() const;
  MapNames withoutCausticsAndMedia() const;  ///< The same without caustics and media: baked light has no maps of these.
};
MapNames mapNames(const Scene& scene, const ShadingSystem& shading, const AtlasSettings& settings);

/// Returns the file of a map in a folder.
std::filesystem::path atlasFile(const std::filesystem::path& folder, const std::string& map, const char* extension);
void makeAtlasFolder(const std::filesystem::path& folder);  ///< Throws WriteError.

using AtlasProgress = std::function<void(float)>;

/// A scene whose atlas is made, and those who are told of the work. All that it refers to outlives it.
struct AtlasWork {
  RayTools tools;
  const MapNames& names;
  const AtlasSettings& settings;
  AtlasProgress progress;  ///< May be empty.
  Stats& stats;
  Log& log;
  const Scene& scene() const { return tools.rays->scene(); }
};

/// Traces photons into FOLDER, one file for each map. Throws FileError.
PhotonFigures writePhotons(const std::filesystem::path& folder, const AtlasWork& work);
/// Traces a part of the same photons into one file for all maps. Throws FileError.
PhotonFigures writePhotonPart(const std::filesystem::path& file, WorkPart part, const AtlasWork& work);
/// Makes the files of writePhotons() from all parts. Throws FileError, also if a part belongs to another scene.
void joinPhotonParts(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder,
                     const MapNames& names, const AtlasSettings& settings, Stats& stats, Log& log);
/// Makes irradiance points from a photon map. A map of more than `most` photons is processed in cubes of about `most`
/// photons. `sight` and `shown`: as in estimateIrradiance(), in world space. Throws FileError.
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
void writeMaps(const std::filesystem::path& folder, WorkPart part, const AtlasWork& work);
/// Makes all three kinds of files for a scene, as far as the folder does not hold them yet. Photons are traced again if
/// the scene or their settings have changed, and groups that receive the same photons keep their maps. Throws
/// FileError.
void writeAtlas(const std::filesystem::path& folder, const AtlasWork& work);

}  // namespace tomales
