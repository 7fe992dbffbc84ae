// Composer: the irradiance atlas (irradiance-atlas 4). Photons, irradiance points and brick maps of a scene, one file
// for each group of objects, in a folder; and the lookup behind gather rays.
//   FOLDER/photons/NAME.ptc  ->  FOLDER/irradiance/NAME.ptc  ->  FOLDER/NAME.bkm
// and the same for NAME.caustic, the part that came by mirrors and glass, which is looked up where the eye sees it, and
// for scene.volume, the fluence in media. Groups are named by Attribute "photon" "globalmap"; what has no name is
// shared out by size among "scene0", "scene1", ... Files are in world space, so that another camera can use them.
// Irradiance in files is E in W/m2. Each names what it was made of (MadeFrom), so that only what has changed since is
// made again.
#pragma once
#include <filesystem>
#include <optional>
#include <set>

#include "gi/brick_map.h"
#include "gi/photon_irradiance.h"
#include "gi/photons.h"

namespace tomales {

struct AtlasSettings {
  PhotonSettings photons;
  PhotonIrradianceSettings irradiance;
  PhotonIrradianceSettings caustics{50, 1};  ///< Sharp: every photon counts.
  /// maxError: a share of the map's mean irradiance (the paper's is absolute). An estimate is a mean over 50 photons,
  /// and every fourth has one: voxels as wide as the disks hold all that they know, in a quarter of the bricks.
  BrickSettings bricks{.maxError = 0.03f, .coarseness = 2};
  size_t mostPhotonBytes = 256 << 20;  ///< That the photons of one unnamed group are expected to take.
  uint64_t world = 0;                  ///< worldSum() of the scene.
};

/// For each of Scene::groups, the names of its maps, and its number there: what touches does not share light.
struct MapNames {
  std::vector<std::string> global;
  std::vector<std::string> caustic;  ///< Ends in kCaustic; empty: has none.
  std::string volume;                ///< Of what flies in media; empty: there are none.
  std::vector<int> surface;  ///< PointCloud::surface() of what lies on it; 0: too small to have light of its own.
  uint64_t world = 0;        ///< Of which the groups are, AtlasSettings::world.
  std::set<std::string> all() const;
  std::set<std::string> ofReflectors()
      const;                    ///< Those that gather rays look up: all but that of media, which shaders read.
  MapNames ofSurfaces() const;  ///< Without what came by mirrors or flies in media: baked light has no maps of these.
};
MapNames mapNames(const Scene& scene, const AtlasSettings& settings);

/// The file of a map in a folder.
std::filesystem::path atlasFile(const std::filesystem::path& folder, const std::string& map, const char* extension);
void makeAtlasFolder(const std::filesystem::path& folder);  ///< Throws FileError.

using AtlasProgress = std::function<void(float)>;

/// Photons into FOLDER, one file a map. Throws FileError.
PhotonFigures writePhotons(const std::filesystem::path& folder, const Scene& scene, const RayScene& rays,
                           const ShadingSystem& shading, const MapNames& names, const AtlasSettings& settings,
                           const AtlasProgress& progress, Stats& stats, Log& log);
/// One photon map -> irradiance points, in cubes of about `most` photons where there are more. Throws FileError.
void writeIrradiance(const std::filesystem::path& photons, const std::filesystem::path& out,
                     const PhotonIrradianceSettings& settings, uint64_t most = kPointsInMemory,
                     EstimateFigures* figures = nullptr);
/// Irradiance points -> brick map; its maxError is relative to their mean. Throws FileError.
BuiltBricks writeIrradianceBricks(const std::filesystem::path& points, const std::filesystem::path& out,
                                  BrickSettings settings);

/// False: they were made of these points and settings already, and are kept. Throws FileError.
bool renewIrradianceBricks(const std::filesystem::path& points, const std::filesystem::path& out,
                           const BrickSettings& settings, Stats& stats);
/// Of a point cloud; nothing is known of one that is missing or damaged.
MadeFrom pointsMadeFrom(const std::filesystem::path& path);

/// All three for a scene, as far as the folder does not hold them yet: photons are traced again if the scene or their
/// settings have changed, and groups to which the same photons come keep their maps. Throws FileError.
void writeAtlas(const std::filesystem::path& folder, const Scene& scene, const RayScene& rays,
                const ShadingSystem& shading, const MapNames& names, const AtlasSettings& settings,
                const AtlasProgress& progress, Stats& stats, Log& log);

/// Brick maps without the photons that they came from: somebody put them there, and they are used as they are.
bool isMadeByHand(const std::filesystem::path& folder);
/// Do the brick maps of a folder hold light that came straight from lights (PhotonSettings::direct)?
bool holdsDirect(const std::filesystem::path& folder);

/// The brick maps of a folder. Threads: lookups are concurrent.
class IrradianceAtlas {
 public:
  /// Maps that are missing are black, with a warning: nothing was lit there. Throws FileError where one is damaged.
  IrradianceAtlas(const std::filesystem::path& folder, const Scene& scene, const MapNames& names, size_t cacheBytes,
                  Log& log);

  /// Names a map that was made from another world than this, if there is one. 0 and maps that do not say: any.
  std::optional<std::string> strange(uint64_t world) const;

  /// E/pi at P (current space) on the side of N, over a radius; 0 where there is nothing.
  vec3 irradianceOverPi(int group, const vec3& P, const vec3& N, float radius) const {
    return look(mapOfGroup_, group, P, N, radius).value_or(vec3(0.0f));
  }
  /// Likewise, of what came by mirrors and glass alone.
  vec3 causticOverPi(int group, const vec3& P, const vec3& N, float radius) const {
    return look(causticOfGroup_, group, P, N, radius).value_or(vec3(0.0f));
  }
  /// As irradianceOverPi(); nothing where there is nothing.
  std::optional<vec3> bakedOverPi(int group, const vec3& P, const vec3& N, float radius) const {
    return look(mapOfGroup_, group, P, N, radius);
  }
  void report(Stats& stats) const;  ///< Bricks, lookups, misses, bytes.

 private:
  using MapOfGroup = std::vector<const BrickMap*>;  ///< Null: no photon came there.
  std::optional<vec3> look(const MapOfGroup& maps, int group, const vec3& P, const vec3& N, float radius) const;
  const BrickMap* open(const std::filesystem::path& file);

  mutable BrickCache cache_;
  mat4 worldFromCurrent_;
  float worldFromCurrentScale_;
  std::vector<std::unique_ptr<const BrickMap>> maps_;  ///< By name.
  MapOfGroup mapOfGroup_, causticOfGroup_;
  std::vector<int> surfaceOfGroup_;
  uint64_t world_ = 0;
  Log& log_;
};

}  // namespace tomales
